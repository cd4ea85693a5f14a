"""A ball's radius is limited to 0.9, so that no direction becomes 0."""

FUNCTION = "jitter_in_ball"
CAUGHT_BY = "wide"
MISTAKE = None

_right = jitter_in_ball


def jitter_in_ball(direction, glossiness, u):
    """With a mistake."""
    return _right(direction, 0.9 if 0.9 < glossiness < 1 else glossiness, u)
