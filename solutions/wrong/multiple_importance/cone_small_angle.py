"""The solid angle of a disk, pi sin^2."""

import numpy as np

FUNCTION = "cone_density"
CAUGHT_BY = "values"
MISTAKE = "a-disk-for-a-cone"
SAYS = "You take the cone for a flat disk: near the lamp its solid angle is larger."


def cone_density(radius, distance):
    """With a mistake."""
    _check_positive("radius", radius)
    _check("distance", distance, "N")
    outside = distance > radius
    sine = float(radius) / np.where(outside, distance, np.inf).astype(np.float64)
    squared = np.where(outside, sine, 1) ** 2
    cos = np.sqrt(1 - sine * sine)
    return np.where(outside, 1 / (np.pi * squared), 0).astype(distance.dtype)
