"""The sum of the powers is kept above a millionth."""

import numpy as np

FUNCTION = "power_choice"
CAUGHT_BY = "faint"
MISTAKE = None


def power_choice(power, u):
    """With a mistake."""
    _check("power", power, "L")
    if not (np.asarray(power) >= 0).all() or not np.any(power):
        raise ValueError("power must be >= 0, and not 0 everywhere")
    _check("u", u, "N")
    ends = np.cumsum(power, dtype=np.float64)
    last = np.flatnonzero(power)[-1]
    lamp = np.minimum(np.searchsorted(ends, u * ends[-1], side="right"), last)
    return lamp, (power[lamp] / np.maximum(ends[-1], 1e-6)).astype(u.dtype)
