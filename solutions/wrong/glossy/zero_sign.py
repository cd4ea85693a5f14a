"""A sign that is 0 where z is."""

import numpy as np

FUNCTION = "orthonormal_basis"
CAUGHT_BY = "poles"
MISTAKE = "breaks-at-z-0"
SAYS = "Your basis fails where z is 0, at right angles to the z axis: what is the sign of 0 there?"


def orthonormal_basis(w):
    """With a mistake."""
    _check_batch("w", w, 3)
    x, y, z = w
    sign = np.sign(z)
    with np.errstate(divide="ignore", invalid="ignore"):
        a = -1 / (sign + z)
        b = x * y * a
        return (
            np.stack((1 + sign * x * x * a, sign * b, -sign * x)),
            np.stack((b, sign + y * y * a, -y)),
        )
