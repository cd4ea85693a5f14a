"""Spreads the batch evenly over the exposure, the largest u first."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = None


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    return np.linspace(open, close, len(u), dtype=u.dtype)[np.argsort(np.argsort(-u))]
