"""Cross products with +z, and nothing for where it is parallel."""

import numpy as np

FUNCTION = "orthonormal_basis"
CAUGHT_BY = "poles"
MISTAKE = "fixed-helper"


def orthonormal_basis(w):
    """With a mistake."""
    _check_batch("w", w, 3)
    with np.errstate(invalid="ignore"):
        u = np.cross(np.array([0, 0, 1], w.dtype), w.T).T
        u = u / np.linalg.norm(u, axis=0)
        return u, np.cross(w.T, u.T).T
