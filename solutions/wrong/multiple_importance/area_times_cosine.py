"""Times the cosine."""

import numpy as np

FUNCTION = "area_density"
CAUGHT_BY = "values"
MISTAKE = "times-the-cosine"
SAYS = "You multiply by the lamp's cosine, and the density is over it."


def area_density(area, distance, cos):
    """With a mistake."""
    _check_positive("area", area)
    _check("distance", distance, "N")
    _check("cos", cos, np.shape(distance)[0])
    return np.maximum(cos, 0) * distance * distance / distance.dtype.type(area)
