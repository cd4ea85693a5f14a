"""One fixed helper axis: no basis where the line runs along it."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "axes"
MISTAKE = "facing-helper-axis"
SAYS = "The basis comes from one fixed axis, and there is none where the line to the light runs along it."


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    dtype = np.result_type(point, u)
    c = np.array(center, float)[:, None]
    w = c - point
    helper = np.array([[0.0], [0.0], [1.0]])
    s = np.cross(w, helper, axis=0)
    s = s / np.maximum(np.sqrt((s * s).sum(axis=0)), 1e-20)
    t = np.cross(w, s, axis=0)
    t = t / np.maximum(np.sqrt((t * t).sum(axis=0)), 1e-20)
    r = float(radius) * np.sqrt(u[0])
    phi = 2 * np.pi * u[1]
    return (c + r * np.cos(phi) * s + r * np.sin(phi) * t).astype(dtype)
