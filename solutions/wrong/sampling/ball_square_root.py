"""The disk's square root."""

import numpy as np

FUNCTION = "ball_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "ball-square-root"
SAYS = (
    "The radius follows the square root, which is right for the disk's area; a ball has a volume."
)


def ball_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 3)
    return np.sqrt(u[2]) * _on_sphere(u[:2])
