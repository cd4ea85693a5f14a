"""Numbers near 0 and 1 are cut off, to be on the safe side."""

import numpy as np

FUNCTION = "disk_by_polar"
CAUGHT_BY = "uniform-alike"
MISTAKE = None


def disk_by_polar(u):
    """With a mistake."""
    _check_batch("u", u, 2)
    radius, turn = np.sqrt(np.clip(u, 0.01, 0.99))
    turn = 2 * np.pi * turn**2
    return np.stack((radius * np.cos(turn), radius * np.sin(turn)))
