"""You weigh all neighbours alike."""

import numpy as np

FUNCTION = "weighted_mean"
CAUGHT_BY = "values"
MISTAKE = "weights-left-out"
SAYS = "You weigh all neighbours alike."


def weighted_mean(means, variances, weights):
    """With a mistake."""
    _check("means", means, 3, "N", "k")
    shape = np.shape(means)
    _check("variances", variances, *shape)
    _check("weights", weights, *shape[1:])
    shares = np.full_like(weights, 1 / weights.shape[1])
    mean = np.einsum("cnk,nk->cn", means, shares)
    variance = np.einsum("cnk,nk->cn", variances, shares**2)
    dtype = _dtype(means, variances, weights)
    return mean.astype(dtype), variance.astype(dtype)
