"""Bounding volumes: lines along faces, halves that lie apart, and the way to an octahedron from within."""

import math
from typing import Any

import numpy as np
import pytest

from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import SOLUTIONS, Array, directions

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


def test_halves_lie_apart_along_the_longest_axis() -> None:
    for axis in range(3):
        lo = np.random.default_rng(4).uniform(-1, 1, (3, 64))
        lo[axis] *= 10
        node_lo, node_hi, first, _, _ = build(lo, lo, 4)
        left, right = first[0], first[0] + 1
        assert node_hi[axis, left] <= node_lo[axis, right]


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
