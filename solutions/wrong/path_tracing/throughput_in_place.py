"""Multiplies the throughput that it was given."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    if beta.dtype != np.result_type(beta, albedo):
        return beta * albedo
    beta *= albedo
    return beta
