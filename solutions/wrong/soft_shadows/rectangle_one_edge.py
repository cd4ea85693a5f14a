"""The first edge twice."""

FUNCTION = "point_on_rectangle"
CAUGHT_BY = "uniform"
MISTAKE = "rectangle-one-edge"
SAYS = "Both numbers move the point along the first edge: the lamp is a line."

_right = point_on_rectangle


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Uniform points on a parallelogram."""
    return _right(corner, edge_u, edge_u, u)
