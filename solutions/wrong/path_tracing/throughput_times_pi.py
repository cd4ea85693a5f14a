"""Divided by the density of the cosine, but not by the reflectance's pi."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "values"
MISTAKE = "times-pi"
SAYS = "You multiply by pi: the reflectance distribution is the albedo over pi."


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    return beta * albedo * beta.dtype.type(np.pi)
