"""The reflectance distribution without the density."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "values"
MISTAKE = "over-pi"
SAYS = "You divide by pi once too often: the density of the directions has it, too."


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    return beta * albedo / beta.dtype.type(np.pi)
