"""Goes by the place in the batch, evenly over the light, whatever u is."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "uniform"
MISTAKE = "not-by-its-column"

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    _check_batch("u", u, 2)
    n = u.shape[1]
    steps = np.arange(n)[None] * np.sqrt([[2], [3], [5]])
    own = (steps % 1).astype(u.dtype)
    return _right(center, radius, own[: len(u)])
