"""Your probability is the sum up to the lamp, with all lamps before it."""

import numpy as np

FUNCTION = "power_choice"
CAUGHT_BY = "share"
MISTAKE = "sum-as-probability"
SAYS = "Your probability is the sum up to the lamp, with all lamps before it."


def power_choice(power, u):
    """With a mistake."""
    _check("power", power, "L")
    if not (np.asarray(power) >= 0).all() or not np.any(power):
        raise ValueError("power must be >= 0, and not 0 everywhere")
    _check("u", u, "N")
    ends = np.cumsum(power, dtype=np.float64)
    last = np.flatnonzero(power)[-1]
    lamp = np.minimum(np.searchsorted(ends, u * ends[-1], side="right"), last)
    return lamp, (ends[lamp] / ends[-1]).astype(u.dtype)
