"""Schlick's approximation with the cosine of the incoming ray, whichever side it comes from."""

import numpy as np

FUNCTION = "fresnel"
CAUGHT_BY = "exact"
MISTAKE = "schlick"


def fresnel(cos_i, eta):
    """Share of light that is reflected."""
    _check_numbers("cos_i", cos_i)
    _check_eta(eta, np.shape(cos_i)[0])
    eta = _of_the_batch(eta, cos_i)
    cos_i = np.clip(cos_i, 0, 1)
    straight = ((1 - eta) / (1 + eta)) ** 2
    return straight + (1 - straight) * (1 - cos_i) ** 5
