"""No more than ten stops either way."""

import numpy as np

FUNCTION = "expose"
CAUGHT_BY = "far"
MISTAKE = None


def expose(radiance, stops):
    """With a mistake."""
    _check_batch("radiance", radiance)
    _check_number("stops", stops, np.isfinite(stops), "finite")
    return radiance * radiance.dtype.type(2.0 ** np.clip(stops, -10, 10))
