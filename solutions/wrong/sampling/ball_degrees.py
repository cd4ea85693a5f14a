"""The angle is in degrees, its cosine takes radians."""

import numpy as np

FUNCTION = "ball_by_polar"
CAUGHT_BY = "smooth"
MISTAKE = "ball-degrees"
SAYS = "Your angle is in degrees, but cosine and sine take radians: neighbouring u go to places far apart."

_right = ball_by_polar


def ball_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 3)
    turned = u.copy()
    turned[1] = turned[1] * u.dtype.type(180 / np.pi) % 1
    return _right(turned)
