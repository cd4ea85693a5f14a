"""Draws numbers of its own instead of warping u."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "columns"
MISTAKE = "not-by-its-column"


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    _check_single(center=center)
    _check_batch("u", u, 2)
    _check_radius(radius)

    v = np.random.default_rng().normal(size=(3, u.shape[1]))
    v /= np.linalg.norm(v, axis=0)
    return (np.array(center)[:, None] + float(radius) * v).astype(u.dtype)
