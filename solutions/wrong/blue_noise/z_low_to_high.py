"""Your bits come in reverse order: the lowest of x is the highest of the number."""

import numpy as np

FUNCTION = "z_order"
CAUGHT_BY = "values"
MISTAKE = "bits-turned-round"
SAYS = "Your bits come in reverse order: the lowest of x is the highest of the number."


def z_order(x, y):
    """With a mistake."""
    _check_pixels(x, y, 1 << 16)
    z = np.zeros(x.shape, np.int64)
    for bit in range(16):
        z |= (x.astype(np.int64) >> bit & 1) << 30 - 2 * bit
        z |= (y.astype(np.int64) >> bit & 1) << 31 - 2 * bit
    return z
