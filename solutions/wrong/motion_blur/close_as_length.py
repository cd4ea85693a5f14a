"""Takes the end of the exposure for its length."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = "close-as-length"
SAYS = "You take `close` for the length of the exposure, but it is the time at which it ends."


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return u.dtype.type(open) + u.dtype.type(close) * u
