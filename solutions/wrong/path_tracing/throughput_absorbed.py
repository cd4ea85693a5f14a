"""The share that the surface swallows."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "values"
MISTAKE = "absorbed-for-returned"
SAYS = "You keep the share that the surface swallows instead of the one that it returns."


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    return beta * (1 - albedo)
