"""1 - cos, whose digits cancel."""

import numpy as np

FUNCTION = "cone_density"
CAUGHT_BY = "far"
MISTAKE = "digits-cancelled"
SAYS = "1 - cos has lost its digits: use sin^2 / (1 + cos) in its place."


def cone_density(radius, distance):
    """With a mistake."""
    _check_positive("radius", radius)
    _check("distance", distance, "N")
    outside = distance > radius
    sine = np.where(
        outside, distance.dtype.type(radius) / np.where(outside, distance, 1), 0.5
    ).astype(distance.dtype)
    left = np.maximum(1 - np.sqrt(1 - sine * sine), np.finfo(distance.dtype).tiny)
    return np.where(outside, np.minimum(1 / (2 * np.pi * left), 1e30), 0).astype(distance.dtype)
