"""The rim only: every point is a whole radius away from the centre."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "uniform"
MISTAKE = "ring"
SAYS = "All your points lie on the disk's rim; its inside gives light too."

_whole_disk = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Points on the disk that faces each point."""
    rim = np.array(u)
    rim[0] = np.nextafter(u.dtype.type(1), u.dtype.type(0))
    return _whole_disk(center, radius, point, rim)
