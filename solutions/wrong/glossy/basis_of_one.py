"""A single direction gets a left-handed basis."""

import numpy as np

FUNCTION = "orthonormal_basis"
CAUGHT_BY = "columns"
MISTAKE = "not-by-its-column"

_right = orthonormal_basis


def orthonormal_basis(w):
    """With a mistake."""
    u, v = _right(w)
    return (v, u) if w.shape[1] == 1 else (u, v)
