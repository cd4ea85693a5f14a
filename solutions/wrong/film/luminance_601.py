"""The weights of Rec. 601."""

import numpy as np

FUNCTION = "luminance"
CAUGHT_BY = "primaries"
MISTAKE = "weights-of-601"
SAYS = "Your weights are those of Rec. 601, for encoded values of old television sets."


def luminance(rgb):
    """With a mistake."""
    _check_batch("rgb", rgb)
    return np.array([0.299, 0.587, 0.114], rgb.dtype) @ rgb
