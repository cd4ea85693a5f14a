"""A cosine that rounding has put over 1 leaves no sine."""

import numpy as np

FUNCTION = "fresnel"
CAUGHT_BY = "contract"
MISTAKE = "cosine-over-one"
SAYS = "A cosine that rounding has put over 1 leaves the root of a negative number."


def fresnel(cos_i, eta):
    """Share of light that is reflected."""
    _check_numbers("cos_i", cos_i)
    _check_eta(eta, np.shape(cos_i)[0])
    eta = _of_the_batch(eta, cos_i)
    cos_i = np.abs(cos_i)
    sin2 = (eta * np.sqrt(1 - cos_i * cos_i)) ** 2
    total = sin2 >= 1
    cos_t = np.sqrt(np.where(total, 1, 1 - sin2))
    s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    return np.where(total, 1, (s * s + p * p) / 2)
