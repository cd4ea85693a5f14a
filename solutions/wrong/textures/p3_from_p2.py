"""The second edge goes from p2 to p3."""

import numpy as np

FUNCTION = "rectangle_uv"
CAUGHT_BY = "inside"
MISTAKE = "diagonal"
SAYS = "You measure v along the diagonal from p2 to p3; both edges begin at p1."


def rectangle_uv(p, p1, p2, p3):
    """Places on a rectangle."""
    _check_batch("p", p, 3)
    for name, point in (("p1", p1), ("p2", p2), ("p3", p3)):
        _check_point(name, point)
    for name, point in (("p2", p2), ("p3", p3)):
        if np.array_equal(point, p1):
            raise ValueError(f"{name} must be another point than p1, got {point}")
    a, b = p2 - p1, p3 - p2
    q = p - p1[:, None]
    return np.stack((a @ q / (a @ a), b @ q / (b @ b))).astype(p.dtype)
