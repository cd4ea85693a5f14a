"""Scales u in place, which is the caller's."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)

    u[2] = np.cbrt(u[2])
    offset = point_on_sphere((0, 0, 0), 1, u[:2]) * u[2]
    return (np.array(center)[:, None] + float(radius) * offset).astype(u.dtype)
