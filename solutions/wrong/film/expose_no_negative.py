"""Channels below 0 are cut off."""

import numpy as np

FUNCTION = "expose"
CAUGHT_BY = "negative"
MISTAKE = None

_right = expose


def expose(radiance, stops):
    """With a mistake."""
    return np.maximum(_right(radiance, stops), 0)
