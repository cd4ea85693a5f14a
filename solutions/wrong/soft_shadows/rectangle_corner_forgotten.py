"""The corner is not added."""

import numpy as np

FUNCTION = "point_on_rectangle"
CAUGHT_BY = "plane"
MISTAKE = "corner-forgotten"
SAYS = "Your light starts at the scene's origin rather than at its corner."

_right = point_on_rectangle


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Uniform points on a parallelogram."""
    return _right(np.zeros(3) * corner, edge_u, edge_v, u)
