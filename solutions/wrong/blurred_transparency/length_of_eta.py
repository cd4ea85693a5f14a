"""Divided by eta: the direction is right, and its length is not."""

import numpy as np

FUNCTION = "refract"
CAUGHT_BY = "unit_length"
MISTAKE = "length-of-eta"
SAYS = "The refracted direction points the right way, and its length is not 1."

_of_unit_length = refract


def refract(direction, normal, eta):
    """Bend by Snell's law."""
    bent, total = _of_unit_length(direction, normal, eta)
    return np.where(total, bent, bent / np.asarray(eta, bent.dtype)), total
