"""Draws numbers of its own, in order of u."""

import numpy as np

FUNCTION = "shutter_times"
CAUGHT_BY = "uniform"
MISTAKE = None


def shutter_times(open, close, u):  # noqa: A002
    """Times while the shutter is open."""
    _check_scalars("u", u)
    if not -np.inf < open <= close < np.inf:
        raise ValueError("open <= close, both finite")
    own = np.sort(np.random.default_rng().random(len(u)))
    return (open + (close - open) * own[np.argsort(np.argsort(u))]).astype(u.dtype)
