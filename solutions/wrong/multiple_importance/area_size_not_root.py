"""The area is squared with the distance."""

import numpy as np

FUNCTION = "area_density"
CAUGHT_BY = "values"
MISTAKE = None


def area_density(area, distance, cos):
    """With a mistake."""
    _check_positive("area", area)
    _check("distance", distance, "N")
    _check("cos", cos, np.shape(distance)[0])
    faces = cos > 0
    near = distance / distance.dtype.type(area)
    return np.where(faces, near * near / np.where(faces, cos, 1), 0)
