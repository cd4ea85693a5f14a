"""A point light: the disk has no size."""

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "inside"
MISTAKE = "disk-centre-only"
SAYS = "All your points are the light's centre, which makes it a point light with hard shadows."

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    return _right(center, 0.0, point, u)
