"""A square root, as for a disk, instead of a cube root."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "square-root"
SAYS = "Your radii would be right for a disk: in a ball it is the third power that counts, not the second."


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)

    offset = point_on_sphere((0, 0, 0), 1, u[:2]) * np.sqrt(u[2])
    return (np.array(center)[:, None] + float(radius) * offset).astype(u.dtype)
