"""The points fill a square instead of the disk."""

FUNCTION = "point_on_disk"
CAUGHT_BY = "inside"
MISTAKE = "square"
SAYS = "Your points fill a square, and its corners stick out of the disk."


def point_on_disk(u):
    """Points of the square."""
    _check_batch("u", u, 2)
    return 2 * u - 1
