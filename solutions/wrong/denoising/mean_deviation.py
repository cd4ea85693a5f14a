"""You return the standard deviation."""

import numpy as np

FUNCTION = "weighted_mean"
CAUGHT_BY = "values"
MISTAKE = "deviation-for-variance"
SAYS = "You return the standard deviation."


def weighted_mean(means, variances, weights):
    """With a mistake."""
    _check("means", means, 3, "N", "k")
    shape = np.shape(means)
    _check("variances", variances, *shape)
    _check("weights", weights, *shape[1:])
    shares = weights / weights.sum(axis=1, keepdims=True)
    mean = np.einsum("cnk,nk->cn", means, shares)
    variance = np.einsum("cnk,nk->cn", variances, shares**2)
    dtype = _dtype(means, variances, weights)
    return mean.astype(dtype), np.sqrt(variance).astype(dtype)
