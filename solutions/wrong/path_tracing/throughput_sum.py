"""The sum of both."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "values"
MISTAKE = "throughput-sum"
SAYS = "Throughput and albedo are added."


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    return beta + albedo
