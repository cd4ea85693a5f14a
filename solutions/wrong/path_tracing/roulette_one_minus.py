"""Divided by the probability to end."""

import numpy as np

FUNCTION = "russian_roulette"
CAUGHT_BY = "mean"
MISTAKE = "roulette-one-minus"
SAYS = "Who survives is divided by the probability to end."


def russian_roulette(beta, u):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    dtype = np.result_type(beta, u)
    q = np.minimum(beta.max(axis=0), 1)
    survives = u < q
    other = np.where(q < 1, 1 - q, 1)
    return survives, np.where(survives, beta / other, 0).astype(dtype)
