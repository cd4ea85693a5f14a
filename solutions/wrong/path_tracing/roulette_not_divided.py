"""Survivors keep what they had."""

import numpy as np

FUNCTION = "russian_roulette"
CAUGHT_BY = "values"
MISTAKE = "not-divided"
SAYS = "Survivors keep the throughput that they had, so the light of those that end is lost."


def russian_roulette(beta, u):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    dtype = np.result_type(beta, u)
    q = np.minimum(beta.max(axis=0), 1)
    survives = u < q
    return survives, np.where(survives, beta, 0).astype(dtype)
