"""A point light: the sphere has no size."""

FUNCTION = "point_on_sphere"
CAUGHT_BY = "radius"
MISTAKE = "sphere-centre-only"
SAYS = "All your points are the light's centre, which makes it a point light with hard shadows."

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    return _right(center, 0.0, u)
