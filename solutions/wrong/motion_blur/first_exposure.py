"""Keeps the exposure of its first call."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = None

_KEPT = {}


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    exposure = _KEPT.setdefault("exposure", (open, close))
    open, close = (u.dtype.type(time) for time in exposure)
    return open + (close - open) * u
