"""Bounding volumes: lines beside boxes, and hierarchies that hold together."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from course.grading.checks.conventions import scattered
from course.grading.checks.laws import DTYPES
from tests.solutions.contract import (
    SOLUTIONS,
    Array,
    directions,
    frozen,
    global_random_state_untouched,
)

slab_test = SOLUTIONS.function("bounding_volumes", "slab_test")
build = SOLUTIONS.function("bounding_volumes", "build")
traverse = SOLUTIONS.function("bounding_volumes", "traverse")

LO, HI = np.array((-1.0, -2, -3)), np.array((1.0, 2, 3))


def boxes_around(p: tuple[Array, ...]) -> tuple[Array, Array]:
    return np.min(p, axis=0), np.max(p, axis=0)


def room() -> tuple[Array, Array, Array]:
    """Eight triangles around the origin: an octahedron with corners at 2."""
    faces = [(x, y, z) for x in (-2, 2) for y in (-2, 2) for z in (-2, 2)]
    return tuple(np.stack([np.eye(3)[k] * face for face in faces], axis=1) for k in range(3))  # type: ignore[return-value]


ROOM = room()


def look_around(origins: Array, directions: Array) -> Any:
    return traverse(build(*boxes_around(ROOM), 2), *ROOM, origins, directions)


dtypes = pytest.mark.parametrize("dtype", DTYPES)


# ---------------------------------------------------------------- one box


@dtypes
@pytest.mark.parametrize("zero", [0.0, -0.0])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_line_along_a_face_is_in_the_box_up_to_the_face(
    dtype: type, zero: float, axis: int
) -> None:
    end = HI.astype(dtype)[axis]
    beyond = np.nextafter(end, dtype(math.inf))
    places = np.array((end, -end, 0, beyond, -beyond), dtype)
    o, d = np.full((3, 5), dtype(-5)), np.ones((3, 5), dtype)
    o[axis], d[axis] = places, zero
    t_near, t_far = slab_test(o, d, -5 + LO, 5 + HI)
    assert (t_near <= t_far).all()
    lo, hi = LO.copy(), HI.copy()
    others = np.arange(3) != axis
    lo[others], hi[others] = -1, 1
    t_near, t_far = slab_test(o, d, lo, hi)
    assert (t_near <= t_far).tolist() == [True, True, True, False, False]


@dtypes
def test_tiny_components_are_no_nan(dtype: type) -> None:
    tiny = float(np.finfo(dtype).smallest_subnormal)
    slopes = np.array((0.0, -0.0, tiny, -tiny, float(np.finfo(dtype).tiny), 1.0, -1.0), dtype)
    d = np.stack([v.ravel() for v in np.meshgrid(slopes, slopes, slopes)])
    d = d[:, d.any(axis=0)]
    for place in (LO, HI, np.zeros(3), np.array((1.0, -2, 0.5)), np.array((5.0, 2, 3))):
        o = np.repeat(place.astype(dtype)[:, None], d.shape[1], axis=1)
        t_near, t_far = slab_test(o, d, LO, HI)
        assert not np.isnan(t_near).any()
        assert not np.isnan(t_far).any()
        if (np.abs(place) <= HI).all():
            # From the box itself, its surface included, every line is in it at t = 0.
            assert (t_near <= 0).all()
            assert (t_far >= 0).all()


@dtypes
def test_lines_are_in_the_box_between_and_nowhere_else(dtype: type) -> None:
    rng = np.random.default_rng(1)
    lo = rng.uniform(-1, 0, (3, 3000))
    hi = lo + rng.uniform(0, 2, (3, 3000))
    o, d = rng.uniform(-1, 1, (3, 3000)), directions(3000, np.float64, 2)
    o, d, lo, hi = (v.astype(dtype) for v in (o, d, lo, hi))
    t_near, t_far = slab_test(o, d, lo, hi)
    assert 300 < (t_near <= t_far).sum() < 2700
    steps = rng.uniform(-5, 5, (40, 3000))
    p = o.astype(float) + steps[:, None] * d
    off = np.maximum(lo - p, p - hi).max(axis=1)
    between = (t_near <= steps) & (steps <= t_far)
    # Right within rounding of the surface.
    assert not (between & (off > 20 * np.finfo(dtype).eps)).any()
    assert not (~between & (off < -20 * np.finfo(dtype).eps)).any()


# ---------------------------------------------------------------- hierarchies


def some_boxes(n: int, dtype: type = np.float64, seed: int = 3) -> tuple[Array, Array]:
    rng = np.random.default_rng(seed)
    lo = rng.uniform(-1, 1, (3, n)).astype(dtype)
    return lo, lo + rng.uniform(0, 0.1, (3, n)).astype(dtype)


def assert_holds_together(
    hierarchy: tuple[Array, ...], lo: Array, hi: Array, leaf_size: int
) -> None:
    """By recursion: every box in one leaf, every node once, and each box bit for bit the union."""
    node_lo, node_hi, first, count, order = hierarchy
    seen: list[int] = []

    def below(node: int) -> Array:
        seen.append(node)
        if count[node]:
            assert count[node] <= leaf_size
            inside = order[first[node] : first[node] + count[node]]
        else:
            inside = np.concatenate([below(first[node] + side) for side in (0, 1)])
            assert inside.size > leaf_size
        assert (node_lo[:, node] == lo[:, inside].min(axis=1)).all()
        assert (node_hi[:, node] == hi[:, inside].max(axis=1)).all()
        return inside

    assert sorted(below(0).tolist()) == list(range(lo.shape[1]))
    assert sorted(seen) == list(range(first.size))


@dtypes
@pytest.mark.parametrize("leaf_size", [1, 2, 4, 7, 1000])
@pytest.mark.parametrize("n", [1, 2, 3, 5, 8, 100, 257])
def test_a_hierarchy_holds_together(dtype: type, n: int, leaf_size: int) -> None:
    lo, hi = (frozen(side) for side in some_boxes(n, dtype))
    with global_random_state_untouched():
        hierarchy = build(lo, hi, leaf_size)
    assert [array.dtype.kind for array in hierarchy] == ["f", "f", "i", "i", "i"]
    assert hierarchy[0].dtype == hierarchy[1].dtype == dtype
    assert_holds_together(hierarchy, lo, hi, leaf_size)
    for turned in (scattered, np.asfortranarray):
        again = build(turned(lo), turned(hi), leaf_size)
        assert all((a == b).all() for a, b in zip(again, hierarchy, strict=True))


def test_boxes_all_alike_are_divided_too() -> None:
    lo, hi = np.zeros((3, 100)), np.ones((3, 100))
    assert_holds_together(build(lo, hi, 3), lo, hi, 3)


def test_float32_and_float64_give_float64() -> None:
    lo, hi = some_boxes(50)
    assert build(lo.astype(np.float32), hi, 2)[0].dtype == np.float64
    assert build(lo, hi.astype(np.float32), 2)[1].dtype == np.float64


@pytest.mark.parametrize("largest", [1e6, 1e-6])
def test_boxes_of_any_size_are_divided(largest: float) -> None:
    lo = np.linspace(-largest, largest, 33, dtype=np.float32) * np.ones((3, 1), np.float32)
    assert_holds_together(build(lo, lo, 1), lo, lo, 1)


def test_halves_lie_apart_along_the_longest_axis() -> None:
    for axis in range(3):
        lo = np.random.default_rng(4).uniform(-1, 1, (3, 64))
        lo[axis] *= 10
        node_lo, node_hi, first, _, _ = build(lo, lo, 4)
        left, right = first[0], first[0] + 1
        assert node_hi[axis, left] <= node_lo[axis, right]


@pytest.mark.parametrize("wrong", [0, -1, 2.5, math.nan])
def test_a_leaf_size_out_of_range_is_refused(wrong: float) -> None:
    with pytest.raises(ValueError, match=f"^leaf_size must be an integer >= 1, got {wrong}$"):
        build(LO[:, None], HI[:, None], wrong)


def test_boxes_of_another_shape_are_refused() -> None:
    lo, hi = some_boxes(5)
    with pytest.raises(ValueError, match=r"^lo must have shape \(3, N\), got \(5, 3\)$"):
        build(lo.T, hi, 1)
    with pytest.raises(ValueError, match=r"^hi must have shape \(3, 5\), got \(3, 4\)$"):
        build(lo, hi[:, :4], 1)
    with pytest.raises(ValueError, match=r"^lo must have at least one column, got none$"):
        build(lo[:, :0], hi[:, :0], 1)


# ---------------------------------------------------------------- the way through


def test_from_the_middle_of_an_octahedron_t_is_that_of_its_planes() -> None:
    d = directions(1000, np.float64, 5)
    triangle, t, boxes, tests = look_around(np.zeros((3, 1000)), d)
    assert t == pytest.approx(2 / np.abs(d).sum(axis=0), rel=1e-12)
    octant = 4 * (d[0] > 0) + 2 * (d[1] > 0) + (d[2] > 0)
    assert (triangle == octant).all()
    assert (boxes >= 3).all()
    assert (tests >= 1).all()


@pytest.mark.parametrize("part", [0, 1, 2, 3, 4])
def test_a_hierarchy_of_other_shapes_is_refused(part: int) -> None:
    hierarchy = list(build(*boxes_around(ROOM), 2))
    hierarchy[part] = hierarchy[part][..., None]
    with pytest.raises(ValueError, match=r"^hierarchy must have shapes \(3, M\), \(3, M\), "):
        traverse(hierarchy, *ROOM, np.zeros((3, 2)), np.ones((3, 2)))


def test_triangles_of_another_number_than_the_hierarchys_are_refused() -> None:
    hierarchy = build(*boxes_around(ROOM), 2)
    for k in range(3):
        wrong = [corner[:, :7] if i == k else corner for i, corner in enumerate(ROOM)]
        with pytest.raises(ValueError, match=rf"^p{k} must have shape \(3, 8\), got \(3, 7\)$"):
            traverse(hierarchy, *wrong, np.zeros((3, 2)), np.ones((3, 2)))
