"""No throughput over 1."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "any-size"
MISTAKE = "clipped"
SAYS = "You cut throughputs at 1; paths may bring more."


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    return np.minimum(beta * albedo, 1)
