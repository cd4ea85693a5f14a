"""One number for the height and for the distance."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "shared-number"
SAYS = "The same random number gives the direction and the distance, so the points lie on a surface within the ball; each of the three coordinates needs a number of its own."


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)

    offset = point_on_sphere((0, 0, 0), 1, u[:2]) * np.cbrt(u[0])
    return (np.array(center)[:, None] + float(radius) * offset).astype(u.dtype)
