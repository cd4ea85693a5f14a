"""The radius counts twice, as a diameter would once."""

FUNCTION = "point_in_ball"
CAUGHT_BY = "inside"
MISTAKE = "ball-twice-as-large"
SAYS = "Your light is twice as large as it should be: the radius goes from the centre to the edge."

_right = point_in_ball


def point_in_ball(center, radius, u):
    """Uniform points in a ball."""
    return _right(center, 2 * radius, u)
