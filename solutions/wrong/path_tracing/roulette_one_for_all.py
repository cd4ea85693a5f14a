"""One number decides for the whole batch."""

import numpy as np

FUNCTION = "russian_roulette"
CAUGHT_BY = "survival"
MISTAKE = "roulette-one-for-all"
SAYS = "One number decides for all paths of the batch."


def russian_roulette(beta, u):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    dtype = np.result_type(beta, u)
    q = np.minimum(beta.max(axis=0), 1)
    survives = u[:1].sum() < q
    safe = np.where(q > 0, q, 1)
    return survives, np.where(survives, beta / safe, 0).astype(dtype)
