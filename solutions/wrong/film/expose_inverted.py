"""More stops, less light."""

import numpy as np

FUNCTION = "expose"
CAUGHT_BY = "values"
MISTAKE = "inverted"
SAYS = "You divide where you should multiply: a stop more is twice as much light."


def expose(radiance, stops):
    """With a mistake."""
    _check_batch("radiance", radiance)
    _check_number("stops", stops, np.isfinite(stops), "finite")
    return radiance * radiance.dtype.type(2.0**-stops)
