"""The radius is squared."""

FUNCTION = "point_on_sphere"
CAUGHT_BY = "radius"
MISTAKE = None

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    return _right(center, radius**2, u)
