"""Runs from close to open."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = "backwards"
SAYS = "Your times run from close back to open; they should rise with u."


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return u.dtype.type(close) - u.dtype.type(close - open) * u
