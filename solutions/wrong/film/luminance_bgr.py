"""Red and blue exchanged."""

import numpy as np

FUNCTION = "luminance"
CAUGHT_BY = "primaries"
MISTAKE = "blue-first"
SAYS = "You weight blue as red and red as blue."


def luminance(rgb):
    """With a mistake."""
    _check_batch("rgb", rgb)
    return np.array([0.0722, 0.7152, 0.2126], rgb.dtype) @ rgb
