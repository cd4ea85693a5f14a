"""Heights from 0 to 1: the upper half of the sphere only."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "uniform"
MISTAKE = "half-sphere"
SAYS = "Only one half of the sphere gets points."


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    _check_single(center=center)
    _check_batch("u", u, 2)
    _check_radius(radius)

    z = u[0]
    r = np.sqrt(1 - z * z)
    phi = 2 * np.pi * u[1]
    points = np.stack([r * np.cos(phi), r * np.sin(phi), z])
    return (np.array(center)[:, None] + float(radius) * points).astype(u.dtype)
