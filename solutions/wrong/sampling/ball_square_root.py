"""The disk's square root."""

import numpy as np

FUNCTION = "ball_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "ball-square-root"


def ball_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 3)
    return np.sqrt(u[2]) * _on_sphere(u[:2])
