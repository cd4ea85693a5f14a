"""The largest channel."""

import numpy as np

FUNCTION = "luminance"
CAUGHT_BY = "primaries"
MISTAKE = "maximum"
SAYS = "You take the largest channel: all three count, by their weights."


def luminance(rgb):
    """With a mistake."""
    _check_batch("rgb", rgb)
    return rgb.max(axis=0)
