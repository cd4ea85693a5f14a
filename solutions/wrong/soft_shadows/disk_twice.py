"""The radius counts twice, as a diameter would once."""

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "inside"
MISTAKE = "disk-twice-as-large"
SAYS = "Your light is twice as large as it should be: the radius goes from the centre to the edge."

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    return _right(center, 2 * radius, point, u)
