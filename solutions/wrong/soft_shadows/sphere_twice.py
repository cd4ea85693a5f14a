"""The radius counts twice, as a diameter would once."""

FUNCTION = "point_on_sphere"
CAUGHT_BY = "radius"
MISTAKE = "sphere-twice-as-large"
SAYS = "Your light is twice as large as it should be: the radius goes from the centre to the edge."

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    return _right(center, 2 * radius, u)
