"""Your lamps are all as probable, whatever their power."""

import numpy as np

FUNCTION = "power_choice"
CAUGHT_BY = "values"
MISTAKE = "lamps-alike"
SAYS = "Your lamps are all as probable, whatever their power."


def power_choice(power, u):
    """With a mistake."""
    _check("power", power, "L")
    if not (np.asarray(power) >= 0).all() or not np.any(power):
        raise ValueError("power must be >= 0, and not 0 everywhere")
    _check("u", u, "N")
    ends = np.arange(1.0, len(power) + 1)
    last = len(power) - 1
    lamp = np.minimum(np.searchsorted(ends, u * ends[-1], side="right"), last)
    return lamp, (np.ones(len(u)) / len(power)).astype(u.dtype)
