"""In the variance you don't square the shares: it doesn't get smaller."""

import numpy as np

FUNCTION = "weighted_mean"
CAUGHT_BY = "evenly"
MISTAKE = "shares-not-squared"
SAYS = "In the variance you don't square the shares: it doesn't get smaller."


def weighted_mean(means, variances, weights):
    """With a mistake."""
    _check("means", means, 3, "N", "k")
    shape = np.shape(means)
    _check("variances", variances, *shape)
    _check("weights", weights, *shape[1:])
    shares = weights / weights.sum(axis=1, keepdims=True)
    mean = np.einsum("cnk,nk->cn", means, shares)
    variance = np.einsum("cnk,nk->cn", variances, shares)
    dtype = _dtype(means, variances, weights)
    return mean.astype(dtype), variance.astype(dtype)
