"""The sums aren't divided by the last one."""

import numpy as np

FUNCTION = "cumulate"
CAUGHT_BY = "rows"
MISTAKE = "not-divided"
SAYS = "Your sums aren't divided by the last one: they are no shares."


def cumulate(weights):
    """With a mistake."""
    _check_weights(weights, "(H, W)", 2)
    weights = np.asarray(weights, np.float64)
    each = weights.sum(axis=1)
    rows = np.cumsum(each)
    share = np.where(each[:, None] > 0, weights / np.where(each > 0, each, 1)[:, None], 1)
    columns = np.cumsum(share, axis=1)
    return rows, columns / columns[:, -1:]
