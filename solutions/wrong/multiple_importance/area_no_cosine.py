"""The lamp's slant is left out."""

import numpy as np

FUNCTION = "area_density"
CAUGHT_BY = "values"
MISTAKE = "no-cosine-of-the-lamp"
SAYS = "You leave the lamp's cosine out: seen at a slant, a lamp fills fewer directions, and each of them is denser."


def area_density(area, distance, cos):
    """With a mistake."""
    _check_positive("area", area)
    _check("distance", distance, "N")
    _check("cos", cos, np.shape(distance)[0])
    return np.where(cos > 0, distance * distance / distance.dtype.type(area), 0 * cos)
