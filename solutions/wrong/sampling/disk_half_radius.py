"""A radius of one half."""

FUNCTION = "disk_by_polar"
CAUGHT_BY = "inside"
MISTAKE = "disk-half-as-large"
SAYS = "Your disk has the diameter 1; its radius should be 1."

_right = disk_by_polar


def disk_by_polar(u):
    """A polar warp."""
    return _right(u) / 2
