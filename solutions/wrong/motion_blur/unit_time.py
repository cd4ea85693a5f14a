"""Hands u back as the time, whatever the shutter does."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = "unit-time"
SAYS = "Your times run from 0 to 1 whatever the shutter does; u still has to be stretched and shifted to the exposure."


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return u.copy()
