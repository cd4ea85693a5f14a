"""A grid from edge to edge of the light."""

import numpy as np

FUNCTION = "light_grid"
CAUGHT_BY = "centres"
MISTAKE = "grid-both-edges"
SAYS = "Your grid goes from edge to edge of the light; its outermost points should be half a cell inside."


def light_grid(corner, edge_u, edge_v, k):
    """The light as a grid of point lights."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    if k < 1:
        raise ValueError(f"k must be >= 1, got {k}")
    t = np.linspace(0, 1, k)
    a = np.tile(t, k)
    b = np.repeat(t, k)
    grid = np.array(corner)[:, None] + np.outer(edge_u, a) + np.outer(edge_v, b)
    return grid.astype(np.float32)
