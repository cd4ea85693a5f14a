"""Takes the times without their signs: no time is before 0."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "inside"
MISTAKE = "never-before-0"
SAYS = "Your times lose their signs: a shutter may well be open before time 0."


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return np.abs(u.dtype.type(open) + u.dtype.type(close - open) * u)
