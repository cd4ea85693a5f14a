"""The lowest bit of your number is that of y: columns and rows are exchanged."""

import numpy as np

FUNCTION = "z_order"
CAUGHT_BY = "values"
MISTAKE = "columns-and-rows-exchanged"
SAYS = "The lowest bit of your number is that of y: columns and rows are exchanged."


def z_order(x, y):
    """With a mistake."""
    _check_pixels(x, y, 1 << 16)
    return _interleaved(y, x)
