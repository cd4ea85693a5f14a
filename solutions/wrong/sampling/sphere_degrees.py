"""The angle is in degrees, its cosine takes radians."""

import numpy as np

FUNCTION = "sphere_by_polar"
CAUGHT_BY = "smooth"
MISTAKE = "sphere-degrees"
SAYS = "Your angle is in degrees, but cosine and sine take radians: neighbouring u go to places far apart."

_right = sphere_by_polar


def sphere_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 2)
    turned = u.copy()
    turned[1] = turned[1] * u.dtype.type(180 / np.pi) % 1
    return _right(turned)
