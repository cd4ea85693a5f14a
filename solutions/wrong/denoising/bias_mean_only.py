"""You subtract the variance of the unfiltered mean alone."""

import numpy as np

FUNCTION = "squared_bias"
CAUGHT_BY = "values"
MISTAKE = "unfiltered-variance-only"
SAYS = "You subtract the variance of the unfiltered mean alone."


def squared_bias(filtered, filtered_variance, mean, variance, share):
    """With a mistake."""
    _check("filtered", filtered, 3, "N")
    pixels = np.shape(filtered)[1]
    _check("filtered_variance", filtered_variance, 3, pixels)
    _check("mean", mean, 3, pixels)
    _check("variance", variance, 3, pixels)
    _check("share", share, pixels)
    explained = variance + 0 * share
    dtype = _dtype(filtered, filtered_variance, mean, variance, share)
    return ((filtered - mean) ** 2 - explained).astype(dtype)
