"""A radius of one half."""

FUNCTION = "sphere_by_polar"
CAUGHT_BY = "radius"
MISTAKE = "sphere-half-as-large"
SAYS = "Your sphere has the diameter 1; its radius should be 1."

_right = sphere_by_polar


def sphere_by_polar(u):
    """A polar warp."""
    return _right(u) / 2
