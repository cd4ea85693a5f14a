"""1 plus stops as a factor."""

import numpy as np

FUNCTION = "expose"
CAUGHT_BY = "values"
MISTAKE = "added-stops"
SAYS = "You add the stops to 1: each stop doubles the light."


def expose(radiance, stops):
    """With a mistake."""
    _check_batch("radiance", radiance)
    _check_number("stops", stops, np.isfinite(stops), "finite")
    return radiance * radiance.dtype.type(1 + stops)
