"""The cross product is taken the wrong way round: a left-handed basis."""

import numpy as np

FUNCTION = "orthonormal_basis"
CAUGHT_BY = "right_handed"
MISTAKE = "left-handed"
SAYS = "Your basis is a fine one, but left-handed: cross(u, v) points against w."


def orthonormal_basis(w):
    """Cross products with the axis that w is farthest from."""
    _check_batch("w", w, 3)
    helper = np.zeros_like(w)
    helper[np.abs(w).argmin(axis=0), np.arange(w.shape[1])] = 1
    u = np.cross(helper, w, axis=0)
    u /= np.linalg.norm(u, axis=0)
    v = np.cross(u, w, axis=0)
    return u, v
