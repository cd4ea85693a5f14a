"""Hands u back as the time, whatever the shutter does."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "even"
MISTAKE = "unit-time"


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return u.copy()
