"""The mean of the albedo's channels."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "values"
MISTAKE = "grey"
SAYS = "You take the mean of the albedo's channels: no wall will colour another."


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    return beta * albedo.mean(axis=0)
