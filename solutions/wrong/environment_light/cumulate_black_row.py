"""A row without weight has no sums: 0 / 0."""

import numpy as np

FUNCTION = "cumulate"
CAUGHT_BY = "black_row"
MISTAKE = "nothing-over-nothing"
SAYS = "A row without weight has no sums: 0 / 0."


def cumulate(weights):
    """With a mistake."""
    _check_weights(weights, "(H, W)", 2)
    weights = np.asarray(weights, np.float64)
    each = weights.sum(axis=1)
    rows = np.cumsum(each / each.sum())
    share = weights / np.where(each > 0, each, 1)[:, None]
    columns = np.cumsum(share, axis=1)
    return rows / rows[-1], columns / np.where(columns[:, -1:] > 0, columns[:, -1:], 1)
