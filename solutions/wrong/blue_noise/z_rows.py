"""Your pixels are numbered row by row: neighbours above and below are far apart."""

import numpy as np

FUNCTION = "z_order"
CAUGHT_BY = "quadrant"
MISTAKE = "row-by-row"
SAYS = "Your pixels are numbered row by row: neighbours above and below are far apart."


def z_order(x, y):
    """With a mistake."""
    _check_pixels(x, y, 1 << 16)
    return y.astype(np.int64) * (1 << 16) + x
