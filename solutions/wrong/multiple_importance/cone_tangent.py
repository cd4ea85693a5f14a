"""radius / distance as the tangent."""

import numpy as np

FUNCTION = "cone_density"
CAUGHT_BY = "values"
MISTAKE = "sine-not-tangent"
SAYS = "The rim of a ball is seen where the ray touches it: there the sine is radius / distance, not the tangent."


def cone_density(radius, distance):
    """With a mistake."""
    _check_positive("radius", radius)
    _check("distance", distance, "N")
    outside = distance > radius
    tangent = float(radius) / np.where(outside, distance, np.inf).astype(np.float64)
    cos = 1 / np.sqrt(1 + tangent * tangent)
    squared = np.where(outside, tangent * cos, 1) ** 2
    return np.where(outside, (1 + cos) / (2 * np.pi * squared), 0).astype(distance.dtype)
