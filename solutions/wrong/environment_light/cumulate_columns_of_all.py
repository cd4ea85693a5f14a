"""Columns are shares of the whole picture, not of their row."""

import numpy as np

FUNCTION = "cumulate"
CAUGHT_BY = "columns"
MISTAKE = "shares-of-the-whole"
SAYS = "Your columns are shares of the whole picture: each row has a distribution of its own."


def cumulate(weights):
    """With a mistake."""
    _check_weights(weights, "(H, W)", 2)
    weights = np.asarray(weights, np.float64)
    each = weights.sum(axis=1)
    rows = np.cumsum(each / each.sum())
    share = np.where(each[:, None] > 0, weights / weights.sum(), 1)
    columns = np.cumsum(share, axis=1)
    return rows / rows[-1], columns
