"""Two steps at a time."""

FUNCTION = "xorshift32"
CAUGHT_BY = "known"
MISTAKE = "two-steps"
SAYS = "You step twice: one call is one step."

_right = xorshift32


def xorshift32(state):
    """The next number of each stream."""
    return _right(_right(state)[0])
