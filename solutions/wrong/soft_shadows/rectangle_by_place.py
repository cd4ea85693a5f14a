"""Goes by the place in the batch, evenly over the light, whatever u is."""

import numpy as np

FUNCTION = "point_on_rectangle"
CAUGHT_BY = "uniform"
MISTAKE = "not-by-its-column"

_right = point_on_rectangle


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Uniform points on a parallelogram."""
    _check_batch("u", u, 2)
    steps = np.arange(u.shape[1])[None] * np.sqrt([[2], [3]])
    return _right(corner, edge_u, edge_v, (steps % 1).astype(u.dtype))
