"""Takes u as (N, 2)."""

import numpy as np

FUNCTION = "point_on_rectangle"
CAUGHT_BY = "contract"
MISTAKE = "rectangle-rows"
SAYS = "The numbers are read as a pair a row: u has shape (2, N), a pair a column."


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Uniform points on a parallelogram."""
    u = np.reshape(u, (-1, 2))
    corner, edge_u, edge_v = (np.asarray(x, u.dtype) for x in (corner, edge_u, edge_v))
    return corner + u[:, :1] * edge_u + u[:, 1:] * edge_v
