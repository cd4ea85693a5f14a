"""Asks whether any ray is totally reflected, for all of them."""

import numpy as np

FUNCTION = "refract"
CAUGHT_BY = "each"
MISTAKE = "total-for-all"
SAYS = "One ray that is totally reflected makes all of the batch so."


def refract(direction, normal, eta):
    """Bend by Snell's law."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_eta(eta, np.shape(direction)[1])
    eta = _of_the_batch(eta, direction, normal)
    cos_i = -(direction * normal).sum(axis=0)
    sin2 = eta * eta * (1 - cos_i * cos_i)
    total = np.full(cos_i.shape, (sin2 > 1).mean() > 0.9 if cos_i.size else False)
    cos_t = np.sqrt(np.maximum(1 - sin2, 0))
    mirrored = direction + 2 * cos_i * normal
    bent = eta * direction + (eta * cos_i - cos_t) * normal
    return np.where(total, mirrored, bent), total
