"""Forgets to square eta under the root."""

import numpy as np

FUNCTION = "refract"
CAUGHT_BY = "snell"
MISTAKE = "eta-once"
SAYS = "Under the root eta stands once; Snell's law has sines squared, and eta with them."


def refract(direction, normal, eta):
    """Bend by Snell's law."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_eta(eta, np.shape(direction)[1])
    eta = _of_the_batch(eta, direction, normal)
    cos_i = -(direction * normal).sum(axis=0)
    sin2 = eta * (1 - cos_i * cos_i)
    total = sin2 > 1
    cos_t = np.sqrt(np.maximum(1 - sin2, 0))
    mirrored = direction + 2 * cos_i * normal
    bent = eta * direction + (eta * cos_i - cos_t) * normal
    return np.where(total, mirrored, bent), total
