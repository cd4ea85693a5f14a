"""Squares u, so that early moments come more often."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = "uneven"
SAYS = "Your times fill the exposure, but some moments come more often than others, so the streak has a bright end."


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return u.dtype.type(open) + u.dtype.type(close - open) * u * u
