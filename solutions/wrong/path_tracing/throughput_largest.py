"""The largest channel of the albedo for all."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "values"
MISTAKE = "throughput-largest"
SAYS = "One channel's albedo is taken for all."


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    return beta * albedo.max(axis=0)
