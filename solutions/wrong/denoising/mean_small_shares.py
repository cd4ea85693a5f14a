"""Shares below a thousandth are left out."""

import numpy as np

FUNCTION = "weighted_mean"
CAUGHT_BY = "uneven"
MISTAKE = None

_right = weighted_mean


def weighted_mean(means, variances, weights):
    """With a mistake."""
    if np.ndim(weights) == 2:
        least = 1e-3 * weights.sum(axis=1, keepdims=True)
        weights = np.where(weights < least, 0, weights).astype(weights.dtype)
    return _right(means, variances, weights)
