"""Points near the poles are moved to where they are cut off."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "uniform-alike"
MISTAKE = "sphere-clipped"
SAYS = "Numbers near 0 and 1 are cut off: there the points pile up on rims."

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Points of a sphere without its caps, in their rims."""
    return _right(center, radius, np.clip(u, 0.015, 0.985).astype(u.dtype))
