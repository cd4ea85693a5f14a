"""A small number is added to the sum of the weights."""

import numpy as np

FUNCTION = "weighted_mean"
CAUGHT_BY = "hardly"
MISTAKE = None


def weighted_mean(means, variances, weights):
    """With a mistake."""
    _check("means", means, 3, "N", "k")
    shape = np.shape(means)
    _check("variances", variances, *shape)
    _check("weights", weights, *shape[1:])
    shares = weights / (weights.sum(axis=1, keepdims=True) + 1e-8)
    mean = np.einsum("cnk,nk->cn", means, shares)
    variance = np.einsum("cnk,nk->cn", variances, shares**2)
    dtype = _dtype(means, variances, weights)
    return mean.astype(dtype), variance.astype(dtype)
