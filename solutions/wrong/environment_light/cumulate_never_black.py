"""A small number is added to all weights."""

import numpy as np

FUNCTION = "cumulate"
CAUGHT_BY = "black"
MISTAKE = None


def cumulate(weights):
    """With a mistake."""
    _check_weights(weights, "(H, W)", 2)
    weights = np.asarray(weights, np.float64) + 1e-12
    each = weights.sum(axis=1)
    rows = np.cumsum(each / each.sum())
    share = np.where(each[:, None] > 0, weights / np.where(each > 0, each, 1)[:, None], 1)
    columns = np.cumsum(share, axis=1)
    return rows / rows[-1], columns / columns[:, -1:]
