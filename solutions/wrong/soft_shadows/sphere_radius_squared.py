"""The radius is squared."""

FUNCTION = "point_on_sphere"
CAUGHT_BY = "radius"
MISTAKE = "sphere-radius-squared"
SAYS = "The points are at the radius's square from the centre: right for a radius of 1 alone."

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    return _right(center, radius**2, u)
