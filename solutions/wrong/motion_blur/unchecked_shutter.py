"""Swaps the ends of a shutter that closes before it opens, rather than refuse it."""

FUNCTION = "shutter_times"
CAUGHT_BY = "refuses"
MISTAKE = "not-refused"


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    first, last = min(open, close), max(open, close)
    return u.dtype.type(first) + u.dtype.type(last - first) * u
