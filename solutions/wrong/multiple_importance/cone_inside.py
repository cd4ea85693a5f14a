"""The whole sphere within the lamp."""

import numpy as np

FUNCTION = "cone_density"
CAUGHT_BY = "inside"
MISTAKE = "a-density-within-the-lamp"
SAYS = "Within the lamp nothing arrives: the density is 0 there."


def cone_density(radius, distance):
    """With a mistake."""
    _check_positive("radius", radius)
    _check("distance", distance, "N")
    outside = distance > radius
    sine = float(radius) / np.where(outside, distance, np.inf).astype(np.float64)
    squared = np.where(outside, sine, 1) ** 2
    cos = np.sqrt(1 - sine * sine)
    return np.where(outside, (1 + cos) / (2 * np.pi * squared), 1 / (4 * np.pi)).astype(
        distance.dtype
    )
