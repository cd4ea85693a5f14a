"""Divides the throughput that it was given."""

import numpy as np

FUNCTION = "russian_roulette"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def russian_roulette(beta, u):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    dtype = np.result_type(beta, u)
    q = np.minimum(beta.max(axis=0), 1)
    survives = u < q
    safe = np.where(q > 0, q, 1)
    if beta.dtype == dtype:
        beta /= safe.astype(dtype)
        return survives, np.where(survives, beta, 0).astype(dtype)
    return survives, np.where(survives, beta / safe, 0).astype(dtype)
