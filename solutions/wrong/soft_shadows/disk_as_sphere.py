"""The whole sphere, not the disk that it shows."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "faces"
MISTAKE = "sphere-not-disk"
SAYS = "Your points lie on the sphere; they belong on a flat disk through its centre."


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    return point_on_sphere(center, radius, u).astype(np.result_type(point, u))
