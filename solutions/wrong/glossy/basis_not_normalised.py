"""The cross product with a helper is not brought to length 1."""

import numpy as np

FUNCTION = "orthonormal_basis"
CAUGHT_BY = "orthonormal"
MISTAKE = "not-normalised"


def orthonormal_basis(w):
    """Cross products with the axis that w is farthest from."""
    _check_batch("w", w, 3)
    helper = np.zeros_like(w)
    helper[np.abs(w).argmin(axis=0), np.arange(w.shape[1])] = 1
    u = np.cross(helper, w, axis=0)
    return u, np.cross(w, u, axis=0)
