"""Points of the ball's surface, none inside."""

import numpy as np

FUNCTION = "point_in_ball"
CAUGHT_BY = "uniform"
MISTAKE = "ball-surface-only"
SAYS = "All your points lie on the surface; the ball's inside gives light too."


def point_in_ball(center, radius, u):
    """Points of a ball."""
    _check_single(center=center)
    _check_batch("u", u, 3)
    _check_radius(radius)
    return point_on_sphere(center, radius, u[:2])
