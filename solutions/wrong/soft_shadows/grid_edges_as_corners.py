"""The edges are taken for two more corners."""

import numpy as np

FUNCTION = "light_grid"
CAUGHT_BY = "centres"
MISTAKE = "grid-edges-as-points"
SAYS = "You take the edges for corners of the light; they are vectors that leave the first corner."


def light_grid(corner, edge_u, edge_v, k):
    """The light as a grid of point lights."""
    _check_single(corner=corner, edge_u=edge_u, edge_v=edge_v)
    if k < 1:
        raise ValueError(f"k must be >= 1, got {k}")
    corner, edge_u, edge_v = np.array(corner), np.array(edge_u), np.array(edge_v)
    steps = (np.arange(k) + 0.5) / k
    points = [corner + a * (edge_u - corner) + b * (edge_v - corner) for a in steps for b in steps]
    return np.array(points, np.float32).T
