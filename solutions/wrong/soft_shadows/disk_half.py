"""The radius is taken for a diameter."""

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "inside"
MISTAKE = "disk-half-as-large"
SAYS = "Your light is half as large as it should be: you take the radius for a diameter."

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    return _right(center, radius / 2, point, u)
