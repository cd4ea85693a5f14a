"""A probability that may be more than 1."""

import numpy as np

FUNCTION = "russian_roulette"
CAUGHT_BY = "certain"
MISTAKE = "not-limited"
SAYS = "You divide by a probability over 1: bright paths lose light."


def russian_roulette(beta, u):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    dtype = np.result_type(beta, u)
    q = beta.max(axis=0)
    survives = u < q
    safe = np.where(q > 0, q, 1)
    return survives, np.where(survives, beta / safe, 0).astype(dtype)
