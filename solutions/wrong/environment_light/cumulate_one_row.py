"""One distribution of columns for all rows."""

import numpy as np

FUNCTION = "cumulate"
CAUGHT_BY = "columns"
MISTAKE = "one-row-for-all"
SAYS = "You took one distribution of columns for all rows."


def cumulate(weights):
    """With a mistake."""
    _check_weights(weights, "(H, W)", 2)
    weights = np.asarray(weights, np.float64)
    each = weights.sum(axis=1)
    rows = np.cumsum(each / each.sum())
    share = np.where(each[:, None] > 0, weights / np.where(each > 0, each, 1)[:, None], 1)
    columns = np.cumsum(np.repeat(share.mean(axis=0)[None], len(rows), axis=0), axis=1)
    return rows / rows[-1], columns / columns[:, -1:]
