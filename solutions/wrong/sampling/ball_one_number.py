"""One number for the radius and for the height."""

import numpy as np

FUNCTION = "ball_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "ball-one-number"
SAYS = "One row of u has no effect: radius, height and turn each need a number of their own."


def ball_by_polar(u):
    """Uniform points in the unit ball."""
    _check_batch("u", u, 3)
    return np.cbrt(u[0]) * _on_sphere(u[:2])
