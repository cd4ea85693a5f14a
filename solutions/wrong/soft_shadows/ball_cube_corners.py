"""Directions of points in a cube: they crowd towards its corners."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "cube-corners"
SAYS = "Your directions are those of points in a cube, which crowd towards its eight corners."


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)

    d = 2 * u - 1
    d = d / np.maximum(np.sqrt((d * d).sum(axis=0)), 1e-20)
    points = np.array(center)[:, None] + float(radius) * np.cbrt(u[2]) * d
    return points.astype(u.dtype)
