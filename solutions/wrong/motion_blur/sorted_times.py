"""Hands the times back in their order, not in that of u."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = "sorted-times"
SAYS = "Your times are sorted, so that they belong to other rays than their u: each column's time comes from its own u."


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return np.sort(u.dtype.type(open) + u.dtype.type(close - open) * u)
