"""The radius is always 1."""

FUNCTION = "point_in_ball"
CAUGHT_BY = "inside"
MISTAKE = "ball-radius-ignored"
SAYS = "Your light always has radius 1, whatever radius is asked for."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    _check_radius(radius)
    return _right(center, 1.0, u)
