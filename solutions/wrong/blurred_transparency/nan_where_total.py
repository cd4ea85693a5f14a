"""Takes the root of negative numbers."""

import numpy as np

FUNCTION = "refract"
CAUGHT_BY = "contract"
MISTAKE = "root-of-negative"
SAYS = "Where reflection is total the root of a negative number is taken."


def refract(direction, normal, eta):
    """Bend by Snell's law."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    _check_eta(eta, np.shape(direction)[1])
    eta = _of_the_batch(eta, direction, normal)
    cos_i = -(direction * normal).sum(axis=0)
    sin2 = eta * eta * (1 - cos_i * cos_i)
    total = sin2 > 1
    with np.errstate(invalid="ignore"):
        cos_t = np.sqrt(1 - sin2)
    mirrored = direction + 2 * cos_i * normal
    bent = eta * direction + (eta * cos_i - cos_t) * normal
    return bent, total
