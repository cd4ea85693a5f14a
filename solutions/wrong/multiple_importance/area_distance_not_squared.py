"""The distance once."""

import numpy as np

FUNCTION = "area_density"
CAUGHT_BY = "values"
MISTAKE = "distance-not-squared"
SAYS = "Your density grows with the distance, and not with its square."


def area_density(area, distance, cos):
    """With a mistake."""
    _check_positive("area", area)
    _check("distance", distance, "N")
    _check("cos", cos, np.shape(distance)[0])
    faces = cos > 0
    return np.where(faces, distance / distance.dtype.type(area) / np.where(faces, cos, 1), 0)
