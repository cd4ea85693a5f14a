"""Sums of rows are kept above 1e-9."""

import numpy as np

FUNCTION = "cumulate"
CAUGHT_BY = "faint"
MISTAKE = None


def cumulate(weights):
    """With a mistake."""
    _check_weights(weights, "(H, W)", 2)
    weights = np.asarray(weights, np.float64)
    each = weights.sum(axis=1)
    rows = np.cumsum(each / each.sum())
    share = np.where(each[:, None] > 1e-9, weights / np.maximum(each, 1e-9)[:, None], 1)
    columns = np.cumsum(share, axis=1)
    return rows / rows[-1], columns / columns[:, -1:]
