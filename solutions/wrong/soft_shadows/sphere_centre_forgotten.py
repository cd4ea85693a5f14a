"""The light's centre is not added."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "radius"
MISTAKE = "sphere-centre-forgotten"
SAYS = "Your points lie about the origin of the scene; the light is somewhere else."


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    _check_single(center=center)
    _check_batch("u", u, 2)
    _check_radius(radius)

    z = 1 - 2 * u[0]
    r = np.sqrt(1 - z * z)
    phi = 2 * np.pi * u[1]
    points = float(radius) * np.stack([r * np.cos(phi), r * np.sin(phi), z])
    return points.astype(u.dtype)
