"""A density over the area of the half that is seen."""

import numpy as np

FUNCTION = "cone_density"
CAUGHT_BY = "values"
MISTAKE = "half-of-the-ball"
SAYS = "You spread the points over the half of the ball: 1 / (2 pi r^2), a density over its area."


def cone_density(radius, distance):
    """With a mistake."""
    _check_positive("radius", radius)
    _check("distance", distance, "N")
    outside = distance > radius
    sine = float(radius) / np.where(outside, distance, np.inf).astype(np.float64)
    squared = np.where(outside, sine, 1) ** 2
    cos = np.sqrt(1 - sine * sine)
    return np.where(outside, 1 / (2 * np.pi * float(radius) ** 2), 0).astype(distance.dtype)
