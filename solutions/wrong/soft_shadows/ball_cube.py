"""Points of a cube, not of a ball."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "inside"
MISTAKE = "cube"
SAYS = "Your points fill a cube around the ball, so some lie outside of it."


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)

    return np.array(center, u.dtype)[:, None] + u.dtype.type(radius) * (2 * u - 1)
