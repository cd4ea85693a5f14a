"""You divide by the number of neighbours, not by the sum of their weights."""

import numpy as np

FUNCTION = "weighted_mean"
CAUGHT_BY = "constant"
MISTAKE = "divided-by-count"
SAYS = "You divide by the number of neighbours, not by the sum of their weights."


def weighted_mean(means, variances, weights):
    """With a mistake."""
    _check("means", means, 3, "N", "k")
    shape = np.shape(means)
    _check("variances", variances, *shape)
    _check("weights", weights, *shape[1:])
    shares = weights / weights.shape[1]
    mean = np.einsum("cnk,nk->cn", means, shares)
    variance = np.einsum("cnk,nk->cn", variances, shares**2)
    dtype = _dtype(means, variances, weights)
    return mean.astype(dtype), variance.astype(dtype)
