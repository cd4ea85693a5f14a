"""Divides by the probability 0 of black paths."""

import numpy as np

FUNCTION = "russian_roulette"
CAUGHT_BY = "dark"
MISTAKE = "roulette-zero-by-zero"
SAYS = "0 is divided by 0 for black paths."


def russian_roulette(beta, u):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    dtype = np.result_type(beta, u)
    q = np.minimum(beta.max(axis=0), 1)
    survives = u < q
    return survives, (survives * (beta / q)).astype(dtype)
