"""Vector arithmetic on (3, N) arrays: rows are x, y, z; a column is a ray or a point.

Every function keeps the dtype of its arguments: no float64 constant ever meets a float32 array here.
"""

from __future__ import annotations

import numpy as np

from course.core.types import Floats


def dot(a: Floats, b: Floats) -> Floats:
    """Scalar product of columns, (3, N) x (3, N) -> (N,); either may be (3, 1)."""
    # One call instead of five: calls are what two threads wait for each other in.
    product: Floats = np.einsum("ij,ij->j", a, b)
    return product


def cross(a: Floats, b: Floats) -> Floats:
    """Vector product of columns, (3, N) x (3, N) -> (3, N)."""
    return np.stack(
        (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    )


def reflect(direction: Floats, normal: Floats) -> Floats:
    """Mirror directions of travel in the surface, d - 2 (d . n) n, (3, N) -> (3, N)."""
    twice = dot(direction, normal)
    twice += twice
    return direction - twice * normal
