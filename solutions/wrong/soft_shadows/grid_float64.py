"""Double precision."""

import numpy as np

FUNCTION = "light_grid"
CAUGHT_BY = "contract"
MISTAKE = "light-grid-float64"
SAYS = "Your result is float64, which single points of float64 make of it; a grid has float32."

_right = light_grid


def light_grid(corner, edge_u, edge_v, k):
    """The light as a grid of point lights."""
    return _right(corner, edge_u, edge_v, k).astype(np.float64)
