"""Mirrors in the caller's array."""

import numpy as np

FUNCTION = "refract"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def refract(direction, normal, eta):
    """Bend by Snell's law."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_eta(eta, np.shape(direction)[1])
    eta = _of_the_batch(eta, direction, normal)
    cos_i = -(direction * normal).sum(axis=0)
    sin2 = eta * eta * (1 - cos_i * cos_i)
    total = sin2 > 1
    cos_t = np.sqrt(np.maximum(1 - sin2, 0))
    mirrored = direction
    mirrored += 2 * cos_i * normal
    bent = 0 + eta * direction + (eta * cos_i - cos_t) * normal
    cos_i *= 1
    return np.where(total, mirrored, bent), total
