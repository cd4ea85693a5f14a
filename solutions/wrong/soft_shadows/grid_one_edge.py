"""The first edge twice."""

FUNCTION = "light_grid"
CAUGHT_BY = "centres"
MISTAKE = "grid-one-edge"
SAYS = "Both directions of the grid run along the first edge."

_right = light_grid


def light_grid(corner, edge_u, edge_v, k):
    """The light as a grid of point lights."""
    return _right(corner, edge_u, edge_u, k)
