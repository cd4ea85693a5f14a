"""You add what noise explains."""

import numpy as np

FUNCTION = "squared_bias"
CAUGHT_BY = "values"
MISTAKE = "noise-added"
SAYS = "You add what noise explains."


def squared_bias(filtered, filtered_variance, mean, variance, share):
    """With a mistake."""
    _check("filtered", filtered, 3, "N")
    pixels = np.shape(filtered)[1]
    _check("filtered_variance", filtered_variance, 3, pixels)
    _check("mean", mean, 3, pixels)
    _check("variance", variance, 3, pixels)
    _check("share", share, pixels)
    explained = filtered_variance + (1 - 2 * share) * variance
    dtype = _dtype(filtered, filtered_variance, mean, variance, share)
    return ((filtered - mean) ** 2 + explained).astype(dtype)
