"""Half the exposure."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = "half-open"
SAYS = "Your times fill half of the exposure only: they stop midway between open and close."


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return u.dtype.type(open) + u.dtype.type((close - open) / 2) * u
