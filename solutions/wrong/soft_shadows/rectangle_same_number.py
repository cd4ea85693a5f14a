"""One random number for both edges."""

import numpy as np

FUNCTION = "point_on_rectangle"
CAUGHT_BY = "uniform"
MISTAKE = "rectangle-same-number"
SAYS = "You use one random number for both edges, so all points lie on a diagonal of the light."


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Uniform points on a parallelogram."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    diagonal = np.add(edge_u, edge_v)
    points = np.array(corner)[:, None] + diagonal[:, None] * u[0]
    return points.astype(u.dtype)
