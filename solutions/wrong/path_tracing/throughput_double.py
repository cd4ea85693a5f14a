"""Double precision, whatever comes in."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    return beta.astype(np.float64) * albedo
