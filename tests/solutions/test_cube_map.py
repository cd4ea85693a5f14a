"""Cube maps: OpenGL's table of directions, bilinear lookup, and what lies beyond the edges."""

from __future__ import annotations

import math
import re
from collections import defaultdict
from collections.abc import Callable
from itertools import product

import numpy as np
import pytest

from course.grading.checks.conventions import scattered
from course.grading.checks.laws import DTYPES
from tests.solutions.contract import SOLUTIONS, Array, directions

face_and_uv = SOLUTIONS.function("cube_map", "face_and_uv")
lookup = SOLUTIONS.function("cube_map", "lookup")
lookup_seamless = SOLUTIONS.function("cube_map", "lookup_seamless")

Lookup = Callable[[Array, Array], Array]
LOOKUPS: dict[str, Lookup] = {"lookup": lookup, "lookup_seamless": lookup_seamless}

SIZES = [1, 2, 3, 8, 17]

dtypes = pytest.mark.parametrize("dtype", DTYPES)
lookups = pytest.mark.parametrize("name", LOOKUPS)
sizes = pytest.mark.parametrize("size", SIZES)


def random_faces(size: int, dtype: type = np.float32, seed: int = 0) -> Array:
    return np.random.default_rng(seed).random((6, size, size, 3), dtype)


# ---------------------------------------------------------------- OpenGL's table, a direction at a time

# Selection of cube map images: the major axis direction, and which of its components are s_c, t_c and m_a. The
# coordinates on the image are s = (s_c / |m_a| + 1) / 2 and t = (t_c / |m_a| + 1) / 2, t = 0 its first row.
TABLE = {
    "+x": ("-z", "-y", "+x"),
    "-x": ("+z", "-y", "-x"),
    "+y": ("+x", "+z", "+y"),
    "-y": ("+x", "-z", "-y"),
    "+z": ("+x", "-y", "+z"),
    "-z": ("-x", "-y", "-z"),
}
AXES = {"+x": 0, "-x": 1, "+y": 2, "-y": 3, "+z": 4, "-z": 5}


def component(d: Array, name: str) -> float:
    return float(d["xyz".index(name[1])]) * (1 if name[0] == "+" else -1)


def by_table(d: Array) -> tuple[int, float, float]:
    """Face, s and t of one direction; ties to x, then y, then z."""
    largest = max(abs(float(x)) for x in d)
    axis = next(a for a in "xyz" if abs(component(d, "+" + a)) == largest)
    face = ("+" if component(d, "+" + axis) > 0 else "-") + axis
    s, t, m = (component(d, name) for name in TABLE[face])
    assert m == largest
    return AXES[face], (s / m + 1) / 2, (t / m + 1) / 2


def on_face(face: int, s: float, t: float, depth: float = 1) -> Array:
    """The direction of a place on a face, s and t from 0 to 1: the table backwards."""
    d = np.zeros(3)
    name = next(name for name, number in AXES.items() if number == face)
    for entry, value in zip(TABLE[name], (2 * s - 1, 2 * t - 1, depth), strict=True):
        d["xyz".index(entry[1])] = value if entry[0] == "+" else -value
    return d


@dtypes
def test_faces_and_coordinates_are_those_of_the_opengl_table(dtype: type) -> None:
    lattice = [d for d in product((-2, -1, 0, 1, 2), repeat=3) if any(d)]
    every = np.concatenate((np.array(lattice, dtype).T, directions(3000, dtype, 1)), axis=1)
    for d in (every, scattered(every)):
        face, u, v = face_and_uv(d)
        assert np.issubdtype(face.dtype, np.integer)
        expected = np.array([by_table(column) for column in d.T]).T
        assert (face == expected[0]).all()
        assert np.abs(u - expected[1]).max() <= np.finfo(dtype).eps
        assert np.abs(v - expected[2]).max() <= np.finfo(dtype).eps


@dtypes
def test_coordinates_are_in_the_unit_interval_for_directions_of_any_length(dtype: type) -> None:
    d = np.array([x for x in product((-1, -0.3, 0, 1e-6, 1), repeat=3) if 1 in np.abs(x)], dtype).T
    expected = face_and_uv(d)
    assert ((expected[1] >= 0) & (expected[1] <= 1)).all()
    assert ((expected[2] >= 0) & (expected[2] <= 1)).all()
    scales = [1e-37, 1e-30, 1e-20, 1e20, 1e30, 1e38]
    scales += [1e-300, 1e300] if dtype is np.float64 else []
    for scale in scales:
        for a, b in zip(face_and_uv(d * dtype(scale)), expected, strict=True):
            assert np.abs(a - b).max() <= 2 * np.finfo(dtype).eps
    # Down to the smallest numbers there are.
    face, u, v = face_and_uv(np.eye(3, dtype=dtype) * np.finfo(dtype).smallest_subnormal)
    assert face.tolist() == [0, 2, 4]
    assert (u == 0.5).all()
    assert (v == 0.5).all()


# ---------------------------------------------------------------- both lookups


def bilinear(face: Array, s: float, t: float) -> Array:
    """One lookup in one face, clamped: the textbook's way, a texel at a time."""
    size = len(face)
    x, y = s * size - 0.5, t * size - 0.5
    total = np.zeros(3)
    for row, column in product(range(math.floor(y), math.floor(y) + 2), range(-1, size + 1)):
        weight = max(0, 1 - abs(x - column)) * max(0, 1 - abs(y - row))
        total += weight * face[min(max(row, 0), size - 1), min(max(column, 0), size - 1)]
    return total


@dtypes
@sizes
def test_lookup_is_bilinear_and_clamped_at_the_edge_of_the_face(dtype: type, size: int) -> None:
    faces = random_faces(size, dtype)
    rng = np.random.default_rng(2)
    places = [(0, 0), (1, 0), (0.5, 1), *rng.random((300, 2)), *rng.random((50, 2)) * 0.5 / size]
    for face in range(6):
        # Not in the very edge, where a direction belongs to two faces.
        inside = [(np.clip(s, 1e-4, 1 - 1e-4), np.clip(t, 1e-4, 1 - 1e-4)) for s, t in places]
        d = np.array([on_face(face, s, t) for s, t in inside], dtype).T
        expected = np.array([bilinear(faces[face], s, t) for s, t in inside]).T
        error = 8 * (size + 1) * np.finfo(dtype).eps
        assert np.abs(lookup(faces, d) - expected).max() <= error


@lookups
@pytest.mark.parametrize("faces_dtype", [np.float16, np.float32, np.float64, np.uint8])
@dtypes
def test_the_faces_do_not_change_the_dtype(name: str, faces_dtype: type, dtype: type) -> None:
    faces = (random_faces(4) * 100).astype(faces_dtype)
    d = directions(500, dtype, 3)
    found = LOOKUPS[name](faces, d)
    assert found.dtype == dtype
    assert np.abs(found - LOOKUPS[name](faces.astype(float), d)).max() <= 1e-3


@lookups
@sizes
def test_lookups_stay_between_the_darkest_and_the_brightest_texel(name: str, size: int) -> None:
    d = directions(20_000, np.float32, 4)
    dark = LOOKUPS[name](np.where(random_faces(size) < 0.2, 1e6, 0).astype(np.float32), d)
    assert dark.min() >= 0
    assert dark.max() <= 1e6 * (1 + 1e-6)
    constant = np.broadcast_to(np.array([0.1, 1e-30, 1e30], np.float32), (6, size, size, 3))
    off = LOOKUPS[name](constant, d) / constant[0, 0, 0, :, None] - 1
    assert np.abs(off).max() <= 1e-6


@lookups
@dtypes
@sizes
def test_lookups_do_not_depend_on_the_length_of_the_direction(
    name: str, dtype: type, size: int
) -> None:
    faces = random_faces(size, dtype)
    corners = np.array([*product((-1, -0.99, 0, 0.4, 1), repeat=3)], dtype).T
    d = np.concatenate((corners[:, np.abs(corners).max(axis=0) > 0], directions(500, dtype, 5)), 1)
    expected = LOOKUPS[name](faces, d)
    assert np.isfinite(expected).all()
    for scale in (1e-30, 1e-10, 1e10, 1e30):
        scaled = LOOKUPS[name](faces, d * dtype(scale))
        assert np.abs(scaled - expected).max() <= 8 * (size + 1) * np.finfo(dtype).eps


@lookups
@pytest.mark.parametrize(
    "shape",
    [(), (6,), (6, 4, 4), (6, 4, 5, 3), (5, 4, 4, 3), (6, 4, 4, 4), (6, 0, 0, 3), (1, 6, 4, 4, 3)],
)
def test_faces_of_another_shape_are_refused(name: str, shape: tuple[int, ...]) -> None:
    message = f"faces must have shape (6, S, S, 3) with S >= 1, got {shape}"
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        LOOKUPS[name](np.zeros(shape, np.float32), directions(5, np.float32, 0))


# ---------------------------------------------------------------- across the edges

# Where two faces meet, so do their outermost texels. Which ones is seen from the points where these touch: the
# middles of texels' sides, as whole numbers on a cube of side 2 S, so that equal points are equal numbers.


def touching(size: int) -> dict[tuple[int, ...], list[tuple[int, int, int]]]:
    """Points in the middle of texels' sides on the cube's edges: the texels that touch there."""
    met = defaultdict(list)
    for face, k in product(range(6), range(size)):
        middle, last = (k + 0.5) / size, size - 1
        for row, column, s, t in (
            (k, 0, 0.0, middle),
            (k, last, 1.0, middle),
            (0, k, middle, 0.0),
            (last, k, middle, 1.0),
        ):
            point = tuple(np.rint(on_face(face, s, t) * size).astype(int).tolist())
            met[point].append((face, row, column))
    return met


def meeting(size: int) -> dict[tuple[int, ...], list[tuple[int, int, int]]]:
    """The eight corners: the texels that meet there."""
    met = defaultdict(list)
    for face, (s, row), (t, column) in product(
        range(6), ((0, 0), (1, size - 1)), ((0, 0), (1, size - 1))
    ):
        corner = tuple(on_face(face, t, s).astype(int).tolist())
        met[corner].append((face, row, column))
    return met


@pytest.mark.parametrize("size", [2, 3, 8])
@pytest.mark.parametrize("inside", [0.0, 0.1, 0.3, 0.5])
def test_within_half_a_texel_of_an_edge_the_neighbours_share_falls_to_nothing(
    size: int, inside: float
) -> None:
    faces = random_faces(size, np.float64)
    for point, texels in touching(size).items():
        for own, other in (texels, texels[::-1]):
            d = np.array(point) / size
            name = next(name for name, number in AXES.items() if number == own[0])
            axis = "xyz".index(name[1])
            (along,) = (a for a in range(3) if abs(point[a]) == size and a != axis)
            # From the edge to the texel's centre it is half a texel: 1 / size of the half side.
            d[along] *= 1 - 2 * (inside + 1e-12) / size
            assert by_table(d)[0] == own[0]
            expected = (0.5 + inside) * faces[own] + (0.5 - inside) * faces[other]
            assert lookup_seamless(faces, d[:, None])[:, 0] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("size", [1, 2, 5])
def test_next_to_a_corner_the_weights_of_three_texels_are_renormalised(size: int) -> None:
    faces = random_faces(size, np.float64)
    rng = np.random.default_rng(8)
    touch = touching(size)
    for corner, texels in meeting(size).items():
        for own in texels:
            name = next(name for name, number in AXES.items() if number == own[0])
            others = [axis for axis in range(3) if axis != "xyz".index(name[1])]
            far = rng.random(2) * 0.499  # how far beyond the texel's centre, in texels
            d = np.array(corner, float)
            weights, mixed = 1 - far, np.zeros(3)
            d[others] *= 1 - (1 - 2 * far) / size
            mixed += weights.prod() * faces[own]
            for k, axis in enumerate(others):
                # The texel beyond the edge that this axis leads over: it touches our own there.
                point = np.array(corner) * size
                point[others[1 - k]] -= corner[others[1 - k]]
                assert abs(point[axis]) == size
                (beyond,) = (t for t in touch[tuple(point.tolist())] if t != own)
                mixed += far[k] * weights[1 - k] * faces[beyond]
            expected = mixed / (1 - far.prod())
            assert lookup_seamless(faces, d[:, None])[:, 0] == pytest.approx(expected, abs=1e-9)
