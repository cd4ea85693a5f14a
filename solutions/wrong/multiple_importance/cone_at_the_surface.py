"""On the lamp itself the density is that of a hemisphere."""

import numpy as np

FUNCTION = "cone_density"
CAUGHT_BY = "inside"
MISTAKE = None


def cone_density(radius, distance):
    """With a mistake."""
    _check_positive("radius", radius)
    _check("distance", distance, "N")
    beyond = distance >= radius
    sine = float(radius) / np.where(beyond, distance, np.inf).astype(np.float64)
    found = (1 + np.sqrt(1 - sine * sine)) / (2 * np.pi) / np.where(beyond, sine, 1) ** 2
    return np.where(beyond, found, 0).astype(distance.dtype)
