"""The corners are left in double precision."""

import numpy as np

FUNCTION = "rectangle_uv"
CAUGHT_BY = "contract"
MISTAKE = "other-dtype"


def rectangle_uv(p, p1, p2, p3):
    """Places on a rectangle."""
    _check_batch("p", p, 3)
    for name, point in (("p1", p1), ("p2", p2), ("p3", p3)):
        _check_point(name, point)
    for name, point in (("p2", p2), ("p3", p3)):
        if np.array_equal(point, p1):
            raise ValueError(f"{name} must be another point than p1, got {point}")
    p1, p2, p3 = (np.asarray(point, float) for point in (p1, p2, p3))
    a, b = p2 - p1, p3 - p1
    q = p - p1[:, None]
    u, v = a @ q / (a @ a), b @ q / (b @ b)
    return np.stack((u, v))
