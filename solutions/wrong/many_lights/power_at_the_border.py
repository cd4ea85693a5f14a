"""A number that is equal to a sum belongs to the lamp behind it: yours finds lamps without power."""

import numpy as np

FUNCTION = "power_choice"
CAUGHT_BY = "black"
MISTAKE = "equal-counts-as-below"
SAYS = "A number that is equal to a sum belongs to the lamp behind it: yours finds lamps without power."


def power_choice(power, u):
    """With a mistake."""
    _check("power", power, "L")
    if not (np.asarray(power) >= 0).all() or not np.any(power):
        raise ValueError("power must be >= 0, and not 0 everywhere")
    _check("u", u, "N")
    ends = np.cumsum(power, dtype=np.float64)
    last = np.flatnonzero(power)[-1]
    lamp = np.minimum(np.searchsorted(ends, u * ends[-1], side="left"), last)
    return lamp, (power[lamp] / ends[-1]).astype(u.dtype)
