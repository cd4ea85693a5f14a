"""Cut off at 1."""

import numpy as np

FUNCTION = "expose"
CAUGHT_BY = "bright"
MISTAKE = "clipped"
SAYS = "You cut off what is over 1: that is left to tone mapping and to the curve."


def expose(radiance, stops):
    """With a mistake."""
    _check_batch("radiance", radiance)
    _check_number("stops", stops, np.isfinite(stops), "finite")
    return np.minimum(radiance * radiance.dtype.type(2.0**stops), 1)
