"""The solid angle."""

import numpy as np

FUNCTION = "cone_density"
CAUGHT_BY = "values"
MISTAKE = "the-solid-angle-itself"
SAYS = "You return the solid angle: the density is 1 over it."


def cone_density(radius, distance):
    """With a mistake."""
    _check_positive("radius", radius)
    _check("distance", distance, "N")
    outside = distance > radius
    sine = float(radius) / np.where(outside, distance, np.inf).astype(np.float64)
    squared = np.where(outside, sine, 1) ** 2
    cos = np.sqrt(1 - sine * sine)
    return np.where(outside, 2 * np.pi * squared / (1 + cos), 0).astype(distance.dtype)
