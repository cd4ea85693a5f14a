"""A radius that is uniform in the ball."""

import numpy as np

FUNCTION = "ball_by_polar"
CAUGHT_BY = "uniform"
MISTAKE = "ball-crowded-centre"
SAYS = "Your points crowd the centre: a uniform radius is not uniform in volume."


def ball_by_polar(u):
    """A polar warp."""
    _check_batch("u", u, 3)
    return u[2] * _on_sphere(u[:2])
