"""A probability that is never small."""

import numpy as np

FUNCTION = "russian_roulette"
CAUGHT_BY = "dark"
MISTAKE = "never-small"
SAYS = "Your probability doesn't fall below a bound of its own, so dark paths survive too often."


def russian_roulette(beta, u):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    dtype = np.result_type(beta, u)
    q = np.minimum(beta.max(axis=0), 1)
    q = np.where(q > 0, np.maximum(q, 0.01), 0)
    survives = u < q
    safe = np.where(q > 0, q, 1)
    return survives, np.where(survives, beta / safe, 0).astype(dtype)
