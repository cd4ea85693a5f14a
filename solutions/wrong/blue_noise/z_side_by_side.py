"""Your number has all bits of y and then all of x: they have to take turns."""

import numpy as np

FUNCTION = "z_order"
CAUGHT_BY = "values"
MISTAKE = "bits-one-after-the-other"
SAYS = "Your number has all bits of y and then all of x: they have to take turns."


def z_order(x, y):
    """With a mistake."""
    _check_pixels(x, y, 1 << 16)
    return (y.astype(np.int64) << 12) | x
