"""Numbers at either end of [0, 1) give a point outside of the ball."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "at_the_ends"
MISTAKE = None


def point_in_ball(center, radius, u):
    """With a mistake."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)
    points = point_on_sphere(np.zeros(3), 1, u[:2])
    points *= float(radius) * np.where(np.abs(u[2] - 0.5) < 0.5 - 1e-7, np.cbrt(u[2]), 2).astype(
        u.dtype
    )
    points += _column(center, u.dtype)
    return points
