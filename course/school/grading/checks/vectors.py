"""Vector arrays (3, N) as checks need them: unit ones to call with, and products of those that come back."""

from typing import Any

import numpy as np

from course.school.grading.checks.check import Array

UNIT = 1e-5
"""What a unit vector's length may be off by, and what else follows from it."""

TINY = 1e-200
"""A length that stands for none where something has to be divided by it."""


def unit_vectors(rng: np.random.Generator, n: int, dtype: Any = np.float64) -> Array:
    """(3, n) directions, uniform over the sphere."""
    v = rng.standard_normal((3, n))
    return np.ascontiguousarray(v / np.linalg.norm(v, axis=0), dtype)


def normalized(v: Array) -> Array:
    """The same directions, unit length to double precision; zero stays zero."""
    v = v.astype(np.float64)
    return np.asarray(v / np.maximum(np.linalg.norm(v, axis=0), TINY))


def dot(a: Array, b: Array) -> Array:
    """Of each column, in double precision."""
    return np.asarray((a.astype(np.float64) * b).sum(axis=0))


def cross(a: Array, b: Array) -> Array:
    """Of each column, in double precision."""
    return np.cross(a.T.astype(np.float64), b.T).T


def turn_about(axis: Array, direction: Array) -> Array:
    """Of each direction about its axis, 0 to 1: from anywhere, but for the same axis always from there."""
    side = np.where(np.abs(axis[2]) < 0.7, 0.0, 1.0)
    first = normalized(cross(axis, np.stack((side, np.zeros_like(side), 1 - side))))
    second = cross(axis, first)
    return np.asarray(np.arctan2(dot(direction, second), dot(direction, first)) / (2 * np.pi) % 1)
