"""The corner is not added."""

import numpy as np

FUNCTION = "light_grid"
CAUGHT_BY = "plane"
MISTAKE = "grid-corner-forgotten"
SAYS = "Your grid starts at the scene's origin rather than at the light's corner."

_right = light_grid


def light_grid(corner, edge_u, edge_v, k):
    """The light as a grid of point lights."""
    return _right(np.zeros(3) * corner, edge_u, edge_v, k)
