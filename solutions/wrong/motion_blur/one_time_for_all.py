"""The whole batch gets the time of its first ray."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = "one-time"
SAYS = "All rays got one and the same moment, so a moving object is sharp, only somewhere else; every ray needs a moment of its own."


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    if len(u) == 0:
        return u.copy()
    return np.full(u.shape, open + (close - open) * u[0], dtype=u.dtype)
