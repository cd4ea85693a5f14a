"""A regular row from open to close that does not depend on u."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = "u-unused"
SAYS = (
    "Your times are a row that doesn't depend on u, so that every batch shows the same few ghosts."
)


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return np.linspace(open, close, len(u), dtype=u.dtype)
