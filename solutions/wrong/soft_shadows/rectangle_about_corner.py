"""The corner is taken for the light's centre."""

import numpy as np

FUNCTION = "point_on_rectangle"
CAUGHT_BY = "inside"
MISTAKE = "corner-as-centre"
SAYS = "You spread the points about the corner, as if it were the light's centre."


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Uniform points on a parallelogram."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    _check_batch("u", u, 2)
    centre, edge_u, edge_v = (np.array(x, u.dtype)[:, None] for x in (corner, edge_u, edge_v))
    return centre + (u[0] - 0.5) * edge_u + (u[1] - 0.5) * edge_v
