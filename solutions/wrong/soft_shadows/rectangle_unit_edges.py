"""Edges of length 1."""

import numpy as np

FUNCTION = "point_on_rectangle"
CAUGHT_BY = "inside"
MISTAKE = "edges-normalised"
SAYS = (
    "Your light's edges are 1 m long, whatever they are given as: an edge is more than a direction."
)

_right = point_on_rectangle


def point_on_rectangle(corner, edge_u, edge_v, u):
    """Uniform points on a parallelogram."""
    edge_u, edge_v = (edge / np.linalg.norm(edge) for edge in (edge_u, edge_v))
    return _right(corner, edge_u, edge_v, u)
