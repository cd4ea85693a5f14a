"""The angle goes half way round."""

import numpy as np

FUNCTION = "point_on_disk"
CAUGHT_BY = "uniform"
MISTAKE = "half-turn"
SAYS = "Your points fill half a disk: the angle goes only half way round."


def point_on_disk(u):
    """Points by radius and angle."""
    _check_batch("u", u, 2)
    two_pi = u.dtype.type(2 * np.pi)
    return np.sqrt(u[0]) * np.stack((np.cos(two_pi / 2 * u[1]), np.sin(two_pi / 2 * u[1])))
