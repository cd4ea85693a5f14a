"""Single points of float64 turn the result into float64."""

import numpy as np

FUNCTION = "point_on_rectangle"
CAUGHT_BY = "contract"
MISTAKE = "point-on-rectangle-float64"
SAYS = "Your result is float64 for float32 numbers; see what single points and constants do to the dtype."


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Uniform points on a parallelogram."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    edges = np.array([edge_u, edge_v], dtype=float).T
    return np.array(corner, dtype=float)[:, None] + edges @ u
