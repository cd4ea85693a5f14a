"""The edges are taken for two more corners."""

import numpy as np

FUNCTION = "point_on_rectangle"
CAUGHT_BY = "plane"
MISTAKE = "rectangle-edges-as-points"
SAYS = "You take the edges for corners of the light; they are vectors that leave the first corner."


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Uniform points on a parallelogram."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    a, b, c = (np.array(x, u.dtype)[:, None] for x in (corner, edge_u, edge_v))
    return a + u[0] * (b - a) + u[1] * (c - a)
