"""A power of e."""

import numpy as np

FUNCTION = "expose"
CAUGHT_BY = "values"
MISTAKE = "power-of-e"
SAYS = "You take a power of e: a stop is a factor of 2."


def expose(radiance, stops):
    """With a mistake."""
    _check_batch("radiance", radiance)
    _check_number("stops", stops, np.isfinite(stops), "finite")
    return radiance * radiance.dtype.type(np.exp(stops))
