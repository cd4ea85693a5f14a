"""Random numbers of double precision."""

FUNCTION = "xorshift32"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"

_right = xorshift32


def xorshift32(state):
    """The next number of each stream."""
    new, random = _right(state)
    return new, new / 2.0**32
