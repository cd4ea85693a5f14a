"""The radius is taken for a diameter."""

FUNCTION = "point_in_ball"
CAUGHT_BY = "inside"
MISTAKE = "ball-half-as-large"
SAYS = "Your light is half as large as it should be: you take the radius for a diameter."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    return _right(center, radius / 2, u)
