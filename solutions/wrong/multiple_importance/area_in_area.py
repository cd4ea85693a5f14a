"""1 / area, in another measure."""

import numpy as np

FUNCTION = "area_density"
CAUGHT_BY = "values"
MISTAKE = "density-in-area"
SAYS = "You return the density over the lamp's area: directions need distance^2 / cos besides."


def area_density(area, distance, cos):
    """With a mistake."""
    _check_positive("area", area)
    _check("distance", distance, "N")
    _check("cos", cos, np.shape(distance)[0])
    return np.where(cos > 0, np.ones_like(distance) / distance.dtype.type(area), 0 * cos)
