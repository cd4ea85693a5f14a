"""Stops as a factor."""

import numpy as np

FUNCTION = "expose"
CAUGHT_BY = "values"
MISTAKE = "linear-stops"
SAYS = "You multiply by the number of stops: each stop doubles the light."


def expose(radiance, stops):
    """With a mistake."""
    _check_batch("radiance", radiance)
    _check_number("stops", stops, np.isfinite(stops), "finite")
    return radiance * radiance.dtype.type(stops)
