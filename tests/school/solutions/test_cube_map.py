"""Cube maps: OpenGL's table of directions, and faces of any dtype."""

from collections.abc import Callable
from itertools import product

import numpy as np
import pytest

from course.school.grading.checks.conventions import scattered
from course.school.grading.checks.laws import DTYPES
from tests.school.solutions.contract import SOLUTIONS, Array, directions

face_and_uv = SOLUTIONS.function("cube_map", "face_and_uv")
lookup = SOLUTIONS.function("cube_map", "lookup")
lookup_seamless = SOLUTIONS.function("cube_map", "lookup_seamless")

Lookup = Callable[[Array, Array], Array]
LOOKUPS: dict[str, Lookup] = {"lookup": lookup, "lookup_seamless": lookup_seamless}

dtypes = pytest.mark.parametrize("dtype", DTYPES)
lookups = pytest.mark.parametrize("name", LOOKUPS)


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


@lookups
@pytest.mark.parametrize("faces_dtype", [np.float16, np.float32, np.float64, np.uint8])
@dtypes
def test_the_faces_do_not_change_the_dtype(name: str, faces_dtype: type, dtype: type) -> None:
    faces = np.random.default_rng(0).integers(0, 100, (6, 4, 4, 3)).astype(faces_dtype)
    d = directions(500, dtype, 3)
    found = LOOKUPS[name](faces, d)
    assert found.dtype == dtype
    assert np.abs(found - LOOKUPS[name](faces.astype(float), d)).max() <= 1e-3
