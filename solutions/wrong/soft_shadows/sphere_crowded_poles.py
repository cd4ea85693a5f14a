"""A uniform polar angle: the points crowd at the poles."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "uniform"
MISTAKE = "crowded-poles"
SAYS = "Your polar angle is uniform, so the points crowd at the two poles; near them a step of the angle covers less area."


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    _check_single(center=center)
    _check_batch("u", u, 2)
    _check_radius(radius)

    theta = np.pi * u[0]
    phi = 2 * np.pi * u[1]
    x = np.sin(theta) * np.cos(phi)
    y = np.sin(theta) * np.sin(phi)
    z = np.cos(theta)
    points = np.array(center)[:, None] + float(radius) * np.stack([x, y, z])
    return points.astype(u.dtype)
