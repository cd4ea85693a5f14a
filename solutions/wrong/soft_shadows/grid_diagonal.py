"""The same step along both edges: point lights on the diagonal only."""

import numpy as np

FUNCTION = "light_grid"
CAUGHT_BY = "centres"
MISTAKE = "grid-diagonal"
SAYS = "All your point lights lie on the light's diagonal: each cell needs a pair of steps, one for each edge."


def light_grid(corner, edge_u, edge_v, k):
    """The light as a grid of point lights."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    if k < 1:
        raise ValueError(f"k must be >= 1, got {k}")
    t = np.repeat((np.arange(k) + 0.5) / k, k)
    grid = np.array(corner)[:, None] + np.outer(edge_u, t) + np.outer(edge_v, t)
    return grid.astype(np.float32)
