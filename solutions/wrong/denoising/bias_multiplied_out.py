"""The square of the difference is multiplied out, and bright pixels lose its digits."""

import numpy as np

FUNCTION = "squared_bias"
CAUGHT_BY = "bright"
MISTAKE = None

_right = squared_bias


def squared_bias(filtered, filtered_variance, mean, variance, share):
    """With a mistake."""
    found = _right(filtered, filtered_variance, mean, variance, share)
    squared = filtered * filtered - 2 * filtered * mean + mean * mean
    return (found - (filtered - mean) ** 2 + squared).astype(found.dtype)
