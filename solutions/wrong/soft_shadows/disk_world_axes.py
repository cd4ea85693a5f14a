"""A disk in the world's x and y, whatever the point."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "faces"
MISTAKE = "fixed-disk"


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    dtype = np.result_type(point, u)
    c = np.array(center, float)[:, None]
    r = float(radius) * np.sqrt(u[0])
    phi = 2 * np.pi * u[1]
    offset = np.stack([r * np.cos(phi), r * np.sin(phi), np.zeros_like(r)])
    return (c + offset).astype(dtype)
