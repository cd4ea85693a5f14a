"""The radius is taken for a diameter."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "radius"
MISTAKE = "sphere-half-as-large"
SAYS = "Your light is half as large as it should be: you take the radius for a diameter."


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    _check_single(center=center)
    _check_batch("u", u, 2)
    _check_radius(radius)

    z = 1 - 2 * u[0]
    r = np.sqrt(1 - z * z)
    phi = 2 * np.pi * u[1]
    points = float(radius) / 2 * np.stack([r * np.cos(phi), r * np.sin(phi), z])
    return (np.array(center)[:, None] + points).astype(u.dtype)
