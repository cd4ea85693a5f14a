"""Directions of points in a cube."""

import numpy as np

FUNCTION = "sphere_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "sphere-cube-corners"
SAYS = "Your directions are those of points in a cube, which crowd towards its eight corners."


def sphere_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 2)
    d = 2 * np.stack((u[0], u[1], (u[0] + u[1] * 7919) % 1)) - 1
    return (d / np.maximum(np.linalg.norm(d, axis=0), 1e-20)).astype(u.dtype)
