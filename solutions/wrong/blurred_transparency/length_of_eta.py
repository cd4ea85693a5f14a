"""Divided by eta: the direction is right, and its length is not."""

import numpy as np

FUNCTION = "refract"
CAUGHT_BY = "unit_length"
MISTAKE = None

_of_unit_length = refract


def refract(direction, normal, eta):
    """Bend by Snell's law."""
    bent, total = _of_unit_length(direction, normal, eta)
    return np.where(total, bent, bent / np.asarray(eta, bent.dtype)), total
