"""Vector arithmetic on (3, N) arrays: rows are x, y, z; columns are vectors or points. The dtype is kept."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats, Floats32


def dot(a: Floats, b: Floats) -> Floats:
    """Dot product of columns, (3, N) x (3, N) -> (N,); either may be (3, 1)."""
    # One NumPy call instead of five: between calls threads wait for the interpreter's lock.
    product: Floats = np.einsum("ij,ij->j", a, b)
    return product


def cross(a: Floats, b: Floats) -> Floats:
    """Cross product of columns, (3, N) x (3, N) -> (3, N)."""
    return np.stack(
        (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    )


def reflect(direction: Floats, normal: Floats) -> Floats:
    """Mirror directions in a surface with unit normals: d - 2 (d . n) n, (3, N) -> (3, N)."""
    twice = dot(direction, normal)
    twice += twice
    return direction - twice * normal


def normalise(v: Floats32) -> None:
    """Divide vectors (3, N) by their lengths, in place; lengths are clamped to 1e-10."""
    squared = dot(v, v)
    np.maximum(squared, np.float32(1e-20), out=squared)
    v *= 1 / np.sqrt(squared)


def repeated(values: Floats32, n: int) -> Floats32:
    """Values (k, n) unchanged, or the single column of (k, 1), repeated n times."""
    return values if values.shape[1] == n else np.repeat(values, n, axis=1)


def gather(table: Floats32, number: NDArray[np.integer[Any]]) -> Floats32:
    """Rows ``number`` (N,) of a table (T, k) float32 as columns (k, N): a C-contiguous copy."""
    return np.ascontiguousarray(table.take(number, axis=0).T)
