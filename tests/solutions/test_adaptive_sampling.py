"""Adaptive sampling: which cells are divided, and that their children fit together to the last bit."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest

from course.grading.checks.laws import DTYPES
from tests.solutions.contract import SOLUTIONS, Array, unit

needs_subdivision = SOLUTIONS.function("adaptive_sampling", "needs_subdivision")
subdivide = SOLUTIONS.function("adaptive_sampling", "subdivide")

dtypes = pytest.mark.parametrize("dtype", DTYPES)


def corners_of(n: int, dtype: type = np.float32, seed: int = 0) -> Array:
    return unit(12, n, dtype, seed).reshape(3, 4, n)


# ---------------------------------------------------------------- which cells


@pytest.mark.parametrize("wrong", [-1.0, -1e-45, math.nan, -math.inf])
def test_a_threshold_out_of_range_is_refused(wrong: float) -> None:
    with pytest.raises(ValueError, match=f"^threshold must be >= 0, got {wrong}$"):
        needs_subdivision(corners_of(5), wrong)


@dtypes
@pytest.mark.parametrize("threshold", [0.25, 0.5, 8.0])
def test_every_pair_in_every_channel_counts_just_over_the_threshold(
    dtype: type, threshold: float
) -> None:
    above = float(np.nextafter(dtype(threshold), dtype(math.inf)))
    for channel in range(3):
        for i, j in combinations(range(4), 2):
            for sign in (1, -1):
                for difference in (above, threshold):
                    cell = np.zeros((3, 4, 1), dtype)
                    # The others lie between the two.
                    cell[channel] = sign * threshold / 2
                    cell[channel, i] = sign * difference
                    cell[channel, j] = 0
                    assert needs_subdivision(cell, threshold)[0] == (difference > threshold)


@dtypes
def test_decisions_are_those_of_all_pairs(dtype: type) -> None:
    corners = (corners_of(5000, dtype, 1) - dtype(0.5)) * dtype(20)
    expected = np.zeros(5000, bool)
    for i, j in combinations(range(4), 2):
        expected |= (np.abs(corners[:, i] - corners[:, j]) > 15).any(axis=0)
    assert 500 < expected.sum() < 4500
    assert (needs_subdivision(corners, 15.0) == expected).all()


def test_cells_of_one_colour_stay_whole() -> None:
    plain = np.repeat(corners_of(500, seed=2)[:, :1], 4, axis=1)
    assert not needs_subdivision(plain, 0.0).any()
    assert not needs_subdivision(corners_of(500, seed=3), math.inf).any()


# ---------------------------------------------------------------- the children


def cells_of(n: int, dtype: type) -> tuple[Array, Array, Array, Array]:
    """Cells of all sizes, far from the origin as well."""
    rng = np.random.default_rng(4)
    x0, y0 = rng.uniform(-1000, 1000, (2, n))
    width, height = 10.0 ** rng.uniform(-6, 3, (2, n))
    return tuple(v.astype(dtype) for v in (x0, y0, x0 + width, y0 + height))  # type: ignore[return-value]


def test_the_unit_cell_has_the_quarters_for_children() -> None:
    zero, one = np.zeros(1, np.float32), np.ones(1, np.float32)
    x0, y0, x1, y1 = subdivide(zero, zero, one, one)
    assert x0[:, 0].tolist() == [0, 0.5, 0, 0.5]
    assert y0[:, 0].tolist() == [0, 0, 0.5, 0.5]
    assert x1[:, 0].tolist() == [0.5, 1, 0.5, 1]
    assert y1[:, 0].tolist() == [0.5, 0.5, 1, 1]


@dtypes
def test_outer_edges_are_the_cells_and_inner_ones_are_shared(dtype: type) -> None:
    cells = cells_of(5000, dtype)
    x0, y0, x1, y1 = subdivide(*cells)
    outside = ((x0, (0, 2)), (y0, (0, 1)), (x1, (1, 3)), (y1, (2, 3)))
    for (edge, children), own in zip(outside, cells, strict=True):
        for child in children:
            assert (edge[child] == own).all()
    middle_x, middle_y = x1[0], y1[0]
    for inner in (x0[1], x1[2], x0[3]):
        assert (inner == middle_x).all()
    for inner in (y0[2], y1[1], y0[3]):
        assert (inner == middle_y).all()
    for low, middle, high in ((cells[0], middle_x, cells[2]), (cells[1], middle_y, cells[3])):
        assert (low <= middle).all()
        assert (middle <= high).all()
        exact = (low.astype(float) + high) / 2
        assert (np.abs(middle - exact) <= np.finfo(dtype).eps * np.abs(exact)).all()


@dtypes
def test_neighbours_share_the_middle_of_their_common_side(dtype: type) -> None:
    x0, y0, x1, y1 = cells_of(1000, dtype)
    right = subdivide(x1, y0, x1 + dtype(1), y1)
    left = subdivide(x0, y0, x1, y1)
    assert (left[2][1] == right[0][0]).all()
    assert (left[3][1] == right[3][0]).all()


def test_five_generations_still_cover_the_pixel_exactly() -> None:
    cells = tuple(np.array([v], np.float32) for v in (3, 5, 4, 6))
    for _ in range(5):
        cells = tuple(edge.ravel() for edge in subdivide(*cells))
    x0, y0, x1, y1 = cells
    assert x0.size == 4**5
    assert ((x1 - x0) * (y1 - y0)).sum() == 1
    # 33 x 33 corners in all, each of them a ray that up to four cells share.
    corners = {*zip(x0, y0, strict=True), *zip(x1, y0, strict=True)}
    corners |= {*zip(x0, y1, strict=True), *zip(x1, y1, strict=True)}
    assert len(corners) == 33**2
