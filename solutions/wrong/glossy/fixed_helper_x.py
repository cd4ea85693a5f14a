"""Gram and Schmidt's way from +x alone."""

import numpy as np

FUNCTION = "orthonormal_basis"
CAUGHT_BY = "poles"
MISTAKE = "fixed-helper"


def orthonormal_basis(w):
    """With a mistake."""
    _check_batch("w", w, 3)
    u = np.array([[1], [0], [0]], w.dtype) - w[0] * w
    length = np.linalg.norm(u, axis=0)
    u = u / np.where(length > 0, length, 1)
    return u, np.cross(w.T, u.T).T
