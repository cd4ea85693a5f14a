"""The albedo of the last surface alone."""

import numpy as np

FUNCTION = "throughput"
CAUGHT_BY = "values"
MISTAKE = "before-forgotten"
SAYS = "You forget what the path had lost before: its throughput is a product over all bounces."


def throughput(beta, albedo):
    """With a mistake."""
    _check_batch("beta", beta, 3)
    _check_batch("albedo", albedo, 3, np.shape(beta)[1])
    return np.array(albedo, np.result_type(beta, albedo))
