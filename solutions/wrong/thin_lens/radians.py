"""The angle is u itself: the factor of a whole turn is missing."""

import numpy as np

FUNCTION = "point_on_disk"
CAUGHT_BY = "uniform"
MISTAKE = "part-turn"
SAYS = "Your points fill a narrow slice: does your angle go all the way round, in radians?"


def point_on_disk(u):
    """Points by radius and angle."""
    _check_batch("u", u, 2)
    return np.sqrt(u[0]) * np.stack((np.cos(u[1]), np.sin(u[1])))
