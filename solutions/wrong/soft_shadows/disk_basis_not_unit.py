"""The basis's cross products are not brought to length 1."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "uniform"
MISTAKE = "facing-basis-not-unit"
SAYS = (
    "The disk is narrower than its radius, and how narrow hangs on the direction: the vectors that span it "
    "are at right angles to the line, but not of length 1."
)


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    dtype = np.result_type(point, u)
    c = np.array(center, float)[:, None]
    w = c - point
    length = np.sqrt((w * w).sum(axis=0))
    w = np.where(length > 0, w / np.where(length > 0, length, 1), [[0.0], [0.0], [1.0]])
    helper = np.zeros_like(w)
    helper[np.abs(w).argmin(axis=0), np.arange(w.shape[1])] = 1
    s = np.cross(w, helper, axis=0)
    t = np.cross(w, s, axis=0)
    r = float(radius) * np.sqrt(u[0])
    phi = 2 * np.pi * u[1]
    return (c + r * np.cos(phi) * s + r * np.sin(phi) * t).astype(dtype)
