"""Point lights at the corners of the cells."""

import numpy as np

FUNCTION = "light_grid"
CAUGHT_BY = "centres"
MISTAKE = "grid-at-corners"
SAYS = "Your point lights stand at the corners of the cells, so the light as a whole is shifted; they belong in the middle of each cell."


def light_grid(corner, edge_u, edge_v, k):
    """The light as a grid of point lights."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    if k < 1:
        raise ValueError(f"k must be >= 1, got {k}")
    corner, edge_u, edge_v = np.array(corner), np.array(edge_u), np.array(edge_v)
    points = [corner + i / k * edge_u + j / k * edge_v for i in range(k) for j in range(k)]
    return np.array(points, np.float32).T
