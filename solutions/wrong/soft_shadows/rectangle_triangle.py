"""A triangle: of each point of the other half, the mirror image in the middle."""

import numpy as np

FUNCTION = "point_on_rectangle"
CAUGHT_BY = "uniform"
MISTAKE = "triangle"
SAYS = "Your points fill one half of the parallelogram only, a triangle."


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Points on the light."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    a, b = np.where(u[0] + u[1] > 1, 1 - u, u)
    corner, edge_u, edge_v = (np.asarray(x, u.dtype)[:, None] for x in (corner, edge_u, edge_v))
    return corner + edge_u * a + edge_v * b
