"""Your numbers lose their high bits: 32 of them need a wide enough dtype."""

import numpy as np

FUNCTION = "z_order"
CAUGHT_BY = "far"
MISTAKE = "sixteen-bits-of-result"
SAYS = "Your numbers lose their high bits: 32 of them need a wide enough dtype."


def z_order(x, y):
    """With a mistake."""
    _check_pixels(x, y, 1 << 16)
    return _interleaved(x, y) & 0xFFFF
