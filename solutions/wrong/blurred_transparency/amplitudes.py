"""Averages the amplitudes."""

import numpy as np

FUNCTION = "fresnel"
CAUGHT_BY = "ends"
MISTAKE = "not-squared"
SAYS = "You average amplitudes; light's power goes with their squares."


def fresnel(cos_i, eta):
    """Share of light that is reflected."""
    _check_numbers("cos_i", cos_i)
    _check_eta(eta, np.shape(cos_i)[0])
    eta = _of_the_batch(eta, cos_i)
    cos_i = np.clip(cos_i, 0, 1)
    sin2 = eta * eta * (1 - cos_i * cos_i)
    total = sin2 >= 1
    cos_t = np.sqrt(np.where(total, 1, 1 - sin2))
    s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    return np.where(total, 1, (np.abs(s) + np.abs(p)) / 2)
