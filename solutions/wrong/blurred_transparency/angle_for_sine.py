"""Multiplies the angle by eta instead of its sine."""

import numpy as np

FUNCTION = "refract"
CAUGHT_BY = "snell"
MISTAKE = "angles"
SAYS = "You multiply the angle by eta; it is its sine that Snell's law is about."


def refract(direction, normal, eta):
    """Bend by Snell's law."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_eta(eta, np.shape(direction)[1])
    eta = _of_the_batch(eta, direction, normal)
    cos_i = -(direction * normal).sum(axis=0)
    angle = eta * np.arccos(np.clip(cos_i, -1, 1))
    total = angle > np.pi / 2
    along = direction + cos_i * normal
    length = np.linalg.norm(along, axis=0)
    along = along / np.where(length == 0, 1, length)
    mirrored = direction + 2 * cos_i * normal
    bent = np.sin(angle) * along - np.cos(angle) * normal
    return np.where(total, mirrored, bent), total
