"""The absolute cosine."""

import numpy as np

FUNCTION = "area_density"
CAUGHT_BY = "behind"
MISTAKE = "lamp-shines-backwards"
SAYS = "Your lamp has a density behind it, where it sends nothing."


def area_density(area, distance, cos):
    """With a mistake."""
    _check_positive("area", area)
    _check("distance", distance, "N")
    _check("cos", cos, np.shape(distance)[0])
    size = np.where(cos == 0, 1, np.abs(cos))
    near = distance / distance.dtype.type(np.sqrt(area))
    return np.where(cos == 0, 0, near * near / size)
