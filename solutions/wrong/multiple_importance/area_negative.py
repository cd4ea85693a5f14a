"""No limit behind the lamp."""

import numpy as np

FUNCTION = "area_density"
CAUGHT_BY = "behind"
MISTAKE = "negative-behind"
SAYS = "Behind the lamp your density is negative."


def area_density(area, distance, cos):
    """With a mistake."""
    _check_positive("area", area)
    _check("distance", distance, "N")
    _check("cos", cos, np.shape(distance)[0])
    size = np.where(cos == 0, 1, cos)
    near = distance / distance.dtype.type(np.sqrt(area))
    return near * near / size
