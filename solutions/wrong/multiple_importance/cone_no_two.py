"""Without the 2 of 2 pi."""

import numpy as np

FUNCTION = "cone_density"
CAUGHT_BY = "values"
MISTAKE = "solid-angle-halved"
SAYS = "A cone's solid angle is 2 pi (1 - cos): a factor of 2 is missing."


def cone_density(radius, distance):
    """With a mistake."""
    _check_positive("radius", radius)
    _check("distance", distance, "N")
    outside = distance > radius
    sine = float(radius) / np.where(outside, distance, np.inf).astype(np.float64)
    squared = np.where(outside, sine, 1) ** 2
    cos = np.sqrt(1 - sine * sine)
    return np.where(outside, (1 + cos) / (np.pi * squared), 0).astype(distance.dtype)
