"""Goes by the place in the batch, evenly over the shape, whatever u is."""

import numpy as np

FUNCTION = "disk_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "not-by-its-column"

_right = disk_by_polar


def disk_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 2)
    steps = np.arange(u.shape[1])[None] * np.sqrt([[2], [3], [5]])
    return _right((steps % 1).astype(u.dtype)[: len(u)])
