"""What finds no sum above it gets the last lamp, though that is dark."""

import numpy as np

FUNCTION = "power_choice"
CAUGHT_BY = "last"
MISTAKE = None


def power_choice(power, u):
    """With a mistake."""
    _check("power", power, "L")
    if not (np.asarray(power) >= 0).all() or not np.any(power):
        raise ValueError("power must be >= 0, and not 0 everywhere")
    _check("u", u, "N")
    ends = np.cumsum(power / np.sum(power))
    last = len(power) - 1
    lamp = np.minimum(np.searchsorted(ends, u, side="right"), last)
    return lamp, (power[lamp] / np.sum(power)).astype(u.dtype)
