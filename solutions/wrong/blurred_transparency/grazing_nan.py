"""0 / 0 along the surface."""

import numpy as np

FUNCTION = "fresnel"
CAUGHT_BY = "contract"
MISTAKE = "grazing-zero-by-zero"
SAYS = "Along the surface 0 is divided by 0."


@np.errstate(invalid="ignore", divide="ignore")
def fresnel(cos_i, eta):
    """Share of light that is reflected."""
    _check_numbers("cos_i", cos_i)
    _check_eta(eta, np.shape(cos_i)[0])
    eta = _of_the_batch(eta, cos_i)
    cos_i = np.clip(cos_i, 0, 1)
    sin2 = eta * eta * (1 - cos_i * cos_i)
    cos_t = np.sqrt(np.maximum(1 - sin2, 0))
    s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    return (s * s + p * p) / 2
