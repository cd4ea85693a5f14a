"""The length of the vector."""

import numpy as np

FUNCTION = "luminance"
CAUGHT_BY = "grey"
MISTAKE = "length"
SAYS = "You take the length of the colour as a vector."


def luminance(rgb):
    """With a mistake."""
    _check_batch("rgb", rgb)
    return np.sqrt((rgb * rgb).sum(axis=0))
