"""Between equal media nothing is mirrored, along the surface neither."""

import numpy as np

FUNCTION = "fresnel"
CAUGHT_BY = "horizon"
MISTAKE = None

_right = fresnel


def fresnel(cos_i, eta):
    """With a mistake."""
    found = _right(cos_i, eta)
    return np.where(np.asarray(eta) == 1, 0, found).astype(found.dtype)
