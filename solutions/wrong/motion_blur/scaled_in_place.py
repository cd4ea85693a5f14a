"""Stretches u where it stands and so writes to its argument."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "untouched"
MISTAKE = "writes-to-arguments"


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    u *= u.dtype.type(close - open)
    u += u.dtype.type(open)
    return u
