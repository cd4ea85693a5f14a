"""The cosine is kept above a thousandth."""

import numpy as np

FUNCTION = "area_density"
CAUGHT_BY = "beside"
MISTAKE = None


def area_density(area, distance, cos):
    """With a mistake."""
    _check_positive("area", area)
    _check("distance", distance, "N")
    _check("cos", cos, np.shape(distance)[0])
    faces = cos > 0
    seen = distance / distance.dtype.type(np.sqrt(area))
    return np.where(faces, seen * seen / np.maximum(cos, 1e-3), 0)
