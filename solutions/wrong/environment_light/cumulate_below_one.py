"""Your last sums aren't exactly 1: a number next to 1 finds no texel."""

import numpy as np

FUNCTION = "cumulate"
CAUGHT_BY = "ends"
MISTAKE = "last-sum-below-1"
SAYS = "Your last sums aren't exactly 1: a number next to 1 finds no texel."


def cumulate(weights):
    """With a mistake."""
    _check_weights(weights, "(H, W)", 2)
    weights = np.asarray(weights, np.float64)
    each = weights.sum(axis=1)
    rows = np.cumsum(each / each.sum())
    share = np.where(each[:, None] > 0, weights / np.where(each > 0, each, 1)[:, None], 1)
    columns = np.cumsum(share, axis=1)
    return rows / rows[-1] * 0.99, columns / columns[:, -1:] * 0.99
