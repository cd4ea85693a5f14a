"""Survivors are white."""

import numpy as np

FUNCTION = "russian_roulette"
CAUGHT_BY = "values"
MISTAKE = "colour-lost"
SAYS = "Survivors lose their colour: each channel is divided by the same probability."


def russian_roulette(beta, u):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_numbers("u", u, np.shape(beta)[1])
    dtype = np.result_type(beta, u)
    q = np.minimum(beta.max(axis=0), 1)
    survives = u < q
    return survives, np.where(survives, np.maximum(q, 1) * np.ones_like(beta), 0).astype(dtype)
