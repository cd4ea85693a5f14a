"""The cube root is missing: a uniform distance crowds the middle."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "crowded-middle"
SAYS = "Your distance from the centre is uniform, so the points crowd in the middle: an inner shell holds less volume than an outer one."


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)

    offset = point_on_sphere((0, 0, 0), 1, u[:2]) * u[2]
    return (np.array(center)[:, None] + float(radius) * offset).astype(u.dtype)
