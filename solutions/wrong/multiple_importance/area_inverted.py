"""The solid angle in place of the density."""

import numpy as np

FUNCTION = "area_density"
CAUGHT_BY = "values"
MISTAKE = "one-over-the-density"
SAYS = "You return the solid angle of the lamp: the density is 1 over it."


def area_density(area, distance, cos):
    """With a mistake."""
    _check_positive("area", area)
    _check("distance", distance, "N")
    _check("cos", cos, np.shape(distance)[0])
    near = distance / distance.dtype.type(np.sqrt(area))
    return np.maximum(cos, 0) / (near * near)
