"""One row of u alone is used, and used for all."""

import numpy as np

FUNCTION = "point_on_sphere"
CAUGHT_BY = "uniform"
MISTAKE = "sphere-one-number"
SAYS = "The same number decides height and angle: the points lie on a curve on the sphere."

_right = point_on_sphere


def point_on_sphere(center, radius, u):
    """Uniform points on a sphere."""
    _check_batch("u", u, 2)
    return _right(center, radius, np.repeat(u[:1], len(u), axis=0))
