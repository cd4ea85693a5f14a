"""A cube root of two digits: the power 0.34 instead of a third."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "order"
MISTAKE = "rounded-root"
SAYS = (
    "Radii are right to a hundredth: their power is nearly the one that a ball needs, but rounded."
)


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)

    offset = point_on_sphere((0, 0, 0), 1, u[:2]) * u[2] ** 0.34
    return (np.array(center)[:, None] + float(radius) * offset).astype(u.dtype)
