"""A radius of one half."""

FUNCTION = "ball_by_polar"
CAUGHT_BY = "inside"
MISTAKE = "ball-half-as-large"
SAYS = "Your ball has the diameter 1; its radius should be 1."

_right = ball_by_polar


def ball_by_polar(u):
    """A polar warp."""
    return _right(u) / 2
