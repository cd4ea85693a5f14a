"""The product of all calls so far."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "layouts"
MISTAKE = "remembers-calls"


_last = {}


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    left = beta * albedo * _last.get(beta.shape, 1)
    _last[beta.shape] = np.clip(left, 0.1, 10).mean()
    return left.astype(np.result_type(beta, albedo))
