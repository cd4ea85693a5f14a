"""Channels below 0 count as 0."""

import numpy as np

FUNCTION = "luminance"
CAUGHT_BY = "negative"
MISTAKE = None


def luminance(rgb):
    """With a mistake."""
    _check_batch("rgb", rgb)
    return np.array([0.2126, 0.7152, 0.0722], rgb.dtype) @ np.maximum(rgb, 0)
