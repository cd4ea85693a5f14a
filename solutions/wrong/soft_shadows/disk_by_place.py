"""Goes by the place in the batch, evenly over the light, whatever u is."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "uniform"
MISTAKE = "not-by-its-column"

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    _check_batch("u", u, 2)
    n = u.shape[1]
    steps = np.arange(n)[None] * np.sqrt([[2], [3], [5]])
    own = (steps % 1).astype(u.dtype)
    return _right(center, radius, point, own[: len(u)])
