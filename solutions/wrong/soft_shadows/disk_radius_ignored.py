"""The radius is always 1."""

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "inside"
MISTAKE = "disk-radius-ignored"
SAYS = "Your light always has radius 1, whatever radius is asked for."

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    _check_radius(radius)
    return _right(center, 1.0, point, u)
