"""On the surface."""

import numpy as np

FUNCTION = "ball_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "ball-surface-only"
SAYS = "All your points lie on the surface: the radius is never drawn."


def ball_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 3)
    return _on_sphere(u[:2])
