"""Sums that end before each row: the first is 0, and the last never 1."""

import numpy as np

FUNCTION = "cumulate"
CAUGHT_BY = "rows"
MISTAKE = "sums-before-the-row"
SAYS = "Your sums end before each row: the first is 0, and the last never 1."


def cumulate(weights):
    """With a mistake."""
    _check_weights(weights, "(H, W)", 2)
    weights = np.asarray(weights, np.float64)
    each = weights.sum(axis=1)
    rows = np.cumsum(each / each.sum())
    share = np.where(each[:, None] > 0, weights / np.where(each > 0, each, 1)[:, None], 1)
    columns = np.cumsum(share, axis=1)
    rows = rows / rows[-1]
    return np.concatenate(([0.0], rows[:-1])), columns / columns[:, -1:]
