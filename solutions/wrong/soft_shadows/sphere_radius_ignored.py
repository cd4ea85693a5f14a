"""The radius is always 1."""

FUNCTION = "point_on_sphere"
CAUGHT_BY = "radius"
MISTAKE = "sphere-radius-ignored"
SAYS = "Your light always has radius 1, whatever radius is asked for."

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    _check_radius(radius)
    return _right(center, 1.0, u)
