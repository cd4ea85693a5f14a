"""Vector arrays of checks: (3, N), one a column."""

from __future__ import annotations

import numpy as np

from course.grading.checks.vectors import (
    cross,
    dot,
    normalized,
    unit_vectors,
)

AXES = np.eye(3, dtype=np.float32)


def test_unit_vectors_fill_the_sphere() -> None:
    """Means of z, z^2, z^4 are 0, 1/3, 1/5 to 6 standard deviations: 2 false fails in 10^8, and the seed is fixed."""
    n = 50_000
    v = unit_vectors(np.random.default_rng(0), n)
    assert v.shape == (3, n)
    assert np.abs(np.linalg.norm(v, axis=0) - 1).max() < 1e-15
    assert np.abs(v.mean(axis=1)).max() < 6 * np.sqrt(1 / 3 / n)
    assert np.abs((v**2).mean(axis=1) - 1 / 3).max() < 6 * np.sqrt((1 / 5 - 1 / 9) / n)
    assert np.abs((v**4).mean(axis=1) - 1 / 5).max() < 6 * np.sqrt((1 / 9 - 1 / 25) / n)
    single = unit_vectors(np.random.default_rng(0), n, np.float32)
    assert single.dtype == np.float32
    assert single.flags.c_contiguous
    assert np.array_equal(single, v.astype(np.float32))


def test_products_are_column_by_column() -> None:
    x, y = AXES, np.roll(AXES, 1, axis=1)
    assert dot(x, x).tolist() == [1, 1, 1]
    assert dot(x, y).tolist() == [0, 0, 0]
    # x cross z = -y, y cross x = -z, z cross y = -x.
    assert np.array_equal(cross(x, y), -np.roll(AXES, -1, axis=1))


def test_products_of_single_precision_are_in_double() -> None:
    a, b = (np.array([[1.0], [s], [0.0]], np.float32) for s in (2.0**-25, 1.0))
    assert dot(a, b).tolist() == [1 + 2.0**-25]
    assert dot(a, a).tolist() == [1 + 2.0**-50]
    assert cross(a, b)[2].tolist() == [1 - 2.0**-25]


def test_normalized() -> None:
    v = np.array([[3.0, 0.0, 0.0], [4.0, 0.0, 1e-30], [0.0, 0.0, 0.0]], np.float32)
    found = normalized(v)
    assert found.dtype == np.float64
    assert np.allclose(found, [[0.6, 0, 0], [0.8, 0, 1], [0, 0, 0]], rtol=0, atol=1e-15)
