"""Between equal media a zero of double precision comes, whatever precision was handed in."""

import numpy as np

FUNCTION = "fresnel"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def fresnel(cos_i, eta):
    """With a mistake."""
    _check_numbers("cos_i", cos_i)
    _check_eta(eta, np.shape(cos_i)[0])
    if np.all(np.asarray(eta) == 1):
        return np.zeros(cos_i.shape)
    eta = _of_the_batch(eta, cos_i)
    cos_i = np.clip(cos_i, 0, 1)
    sin_t = eta * np.sqrt((1 - cos_i) * (1 + cos_i))
    cos_t_squared = (1 - sin_t) * (1 + sin_t)
    total = cos_t_squared <= 0
    cos_t = np.sqrt(np.where(total, 0, cos_t_squared))
    cos_i = np.where(total, 1, cos_i)
    across = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    within = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    return 0.5 * (across * across + within * within)
