"""Every second path ends, however bright."""

import numpy as np

FUNCTION = "russian_roulette"
CAUGHT_BY = "survival"
MISTAKE = "roulette-half"
SAYS = "Half of the paths end, however bright they are."


def russian_roulette(beta, u):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    dtype = np.result_type(beta, u)
    survives = (u < 0.5) & (beta.max(axis=0) > 0)
    return survives, np.where(survives, 2 * beta, 0).astype(dtype)
