"""The basis divides by 1 + z and breaks next to -z."""

import numpy as np

FUNCTION = "orthonormal_basis"
CAUGHT_BY = "poles"
MISTAKE = "breaks-at-minus-z"
SAYS = "Your basis is right almost everywhere, but falls to pieces next to -z: what do you divide by there?"


def orthonormal_basis(w):
    """Frisvad's basis, -z treated on its own."""
    _check_batch("w", w, 3)
    x, y, z = w
    pole = z <= -1
    a = 1 / np.where(pole, 1, 1 + z)
    b = -x * y * a
    u = np.stack((1 - x * x * a, b, -x))
    v = np.stack((b, 1 - y * y * a, -y))
    u[:, pole] = np.array([[0], [-1], [0]])
    v[:, pole] = np.array([[-1], [0], [0]])
    return u, v
