"""Divides by the distance, which is zero for a point at the centre."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "at-centre"
MISTAKE = "facing-centre-divides"
SAYS = "At the light's centre the distance is 0, and it is divided by."


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    dtype = np.result_type(point, u)
    c = np.array(center, float)[:, None]
    w = c - point
    with np.errstate(invalid="ignore", divide="ignore"):
        w = w / np.sqrt((w * w).sum(axis=0))
        helper = np.where(np.abs(w[0]) > 0.9, [[0.0], [1.0], [0.0]], [[1.0], [0.0], [0.0]])
        s = np.cross(w, helper, axis=0)
        s = s / np.sqrt((s * s).sum(axis=0))
        t = np.cross(w, s, axis=0)
    r = float(radius) * np.sqrt(u[0])
    phi = 2 * np.pi * u[1]
    return (c + r * np.cos(phi) * s + r * np.sin(phi) * t).astype(dtype)
