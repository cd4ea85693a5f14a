"""Times are always float64."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return np.float64(open) + np.float64(close - open) * u.astype(np.float64)
