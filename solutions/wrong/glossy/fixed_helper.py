"""Every direction is crossed with the same up vector, +-y too."""

import numpy as np

FUNCTION = "orthonormal_basis"
CAUGHT_BY = "poles"
MISTAKE = "fixed-helper"
SAYS = "Your basis fails for directions along one axis: is your helper vector parallel to w there?"


def orthonormal_basis(w):
    """Cross products with the up vector."""
    _check_batch("w", w, 3)
    up = np.zeros_like(w)
    up[1] = 1
    u = np.cross(up, w, axis=0)
    length = np.linalg.norm(u, axis=0)
    u = u / np.where(length == 0, 1, length)
    return u, np.cross(w, u, axis=0)
