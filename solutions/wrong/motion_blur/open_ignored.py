"""Every exposure starts at time 0."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = "open-ignored"
SAYS = "Your exposure starts at time 0; the shutter opens at `open`, which may be any time."


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return u * u.dtype.type(close)
