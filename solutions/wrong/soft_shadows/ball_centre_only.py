"""A point light: the ball has no size."""

FUNCTION = "point_in_ball"
CAUGHT_BY = "inside"
MISTAKE = "ball-centre-only"
SAYS = "All your points are the light's centre, which makes it a point light with hard shadows."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    return _right(center, 0.0, u)
