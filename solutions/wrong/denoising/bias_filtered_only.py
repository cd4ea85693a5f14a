"""You subtract the variance of the filtered mean alone; the unfiltered one is noisy, too."""

import numpy as np

FUNCTION = "squared_bias"
CAUGHT_BY = "values"
MISTAKE = "filtered-variance-only"
SAYS = "You subtract the variance of the filtered mean alone; the unfiltered one is noisy, too."


def squared_bias(filtered, filtered_variance, mean, variance, share):
    """With a mistake."""
    _check("filtered", filtered, 3, "N")
    pixels = np.shape(filtered)[1]
    _check("filtered_variance", filtered_variance, 3, pixels)
    _check("mean", mean, 3, pixels)
    _check("variance", variance, 3, pixels)
    _check("share", share, pixels)
    explained = filtered_variance
    dtype = _dtype(filtered, filtered_variance, mean, variance, share)
    return ((filtered - mean) ** 2 - explained).astype(dtype)
