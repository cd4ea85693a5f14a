"""From an exponent of 1000 on the surface is taken for a mirror."""

import numpy as np

FUNCTION = "sample_phong_lobe"
CAUGHT_BY = "narrow"
MISTAKE = None

_right = sample_phong_lobe


def sample_phong_lobe(direction, exponent, u):
    """With a mistake."""
    if exponent >= 1000:
        _check_batch("direction", direction, 3)
        _check_batch("u", u, 2, np.shape(direction)[1])
        return direction.astype(np.result_type(direction, u))
    return _right(direction, exponent, u)
