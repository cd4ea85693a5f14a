"""In the variance you divide squared weights by their sum, not by the square of it."""

import numpy as np

FUNCTION = "weighted_mean"
CAUGHT_BY = "evenly"
MISTAKE = "squares-over-sum"
SAYS = "In the variance you divide squared weights by their sum, not by the square of it."


def weighted_mean(means, variances, weights):
    """With a mistake."""
    _check("means", means, 3, "N", "k")
    shape = np.shape(means)
    _check("variances", variances, *shape)
    _check("weights", weights, *shape[1:])
    shares = weights / weights.sum(axis=1, keepdims=True)
    mean = np.einsum("cnk,nk->cn", means, shares)
    variance = np.einsum("cnk,nk->cn", variances, shares * weights)
    dtype = _dtype(means, variances, weights)
    return mean.astype(dtype), variance.astype(dtype)
