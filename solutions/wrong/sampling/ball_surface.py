"""On the surface."""

import numpy as np

FUNCTION = "ball_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "ball-surface-only"


def ball_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 3)
    return _on_sphere(u[:2])
