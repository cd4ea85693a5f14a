"""Takes whatever is nearer than a hundredth of a metre for the centre itself."""

import numpy as np

FUNCTION = "point_on_facing_disk"
CAUGHT_BY = "axes"
MISTAKE = "facing-near-as-centre"
SAYS = "Points that are merely near the light's centre are treated like the centre itself."

_right = point_on_facing_disk


def point_on_facing_disk(center, radius, point, u):
    """Uniform points on the disk that faces each point."""
    _check_single(center=center)
    _check_batch("point", point, 3)
    _check_batch("u", u, 2, np.shape(point)[1])
    _check_radius(radius)
    centre = np.asarray(center, point.dtype)[:, None]
    near = np.linalg.norm(point - centre, axis=0) < 0.01
    return _right(center, radius, np.where(near, centre, point), u)
