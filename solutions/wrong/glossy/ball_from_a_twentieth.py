"""What is glossy by less than a twentieth is taken for a mirror."""

FUNCTION = "jitter_in_ball"
CAUGHT_BY = "narrow"
MISTAKE = None

_right = jitter_in_ball


def jitter_in_ball(direction, glossiness, u):
    """With a mistake."""
    return _right(direction, 0.0 if 0 < glossiness < 0.05 else glossiness, u)
