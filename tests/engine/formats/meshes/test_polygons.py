"""Polygons of OBJ and PLY files are cut so that their triangles fill them once, whatever their forms."""

import math
import time
import warnings
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from course.base.errors import CourseWarning
from course.engine.formats.meshes.crossings import _along_a_line, _by_pairs
from course.engine.formats.meshes.files import read_mesh
from course.engine.formats.meshes.polygons import cut
from course.engine.shapes.mesh import Mesh
from tests.lengths import fewer

Points = NDArray[np.float64]

U = np.array([(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)], float)
ARROW = np.array([(0, 0), (4, 0), (1, 1), (0, 4)], float)
KEYHOLE = np.array(
    [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)], float
)
"""A square of 16 with a hole of 1, joined to its rim by a bridge that is there twice."""
STRAIGHT = np.array(
    [(0, 0), (1, 0), (2, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1.5, 1), (1, 1), (1, 3), (0, 3)],
    float,
)
"""The U with corners within its edges."""
STEPS = np.array([(0, 0), (3, 0), (3, 1), (2, 1), (2, 2), (1, 2), (1, 3), (0, 3)], float)

SIMPLE = {
    "U": (U, 7),
    "arrow": (ARROW, 4),
    "keyhole": (KEYHOLE, 15),
    "corners in edges": (STRAIGHT, 7),
    "steps": (STEPS, 6),
}

BOW = np.array([(0, 0), (2, 2), (2, 0), (0, 2)], float)
OVERLAP = np.array(
    [(0, 0), (6, 0), (6, 6), (2, 6), (2, -2), (3, -2), (3, 5), (5, 5), (5, 1), (0, 1)], float
)
"""Turns left almost everywhere, and lies over itself: its triangles have the area that its corners say."""
PENTAGRAM = np.array([(math.cos(k * 0.8 * math.pi), math.sin(k * 0.8 * math.pi)) for k in range(5)])

WINDING = np.array(
    [(0, 0)]
    + [((1 + 0.2 * k) * math.cos(k * 0.9), (1 + 0.2 * k) * math.sin(k * 0.9)) for k in range(9)]
)
"""Turns left around its first corner, more than once: all triangles of a fan from there are turned alike."""

CROSSED = {"winding": WINDING, "bow": BOW, "overlap": OVERLAP, "pentagram": PENTAGRAM}


def tilted(places: Points) -> Points:
    """Places of a plane in space, (N, 3): turned, so that no axis lies in the plane, and moved."""
    a, b = np.array([2, 1, 2]) / 3, np.array([-2, 2, 1]) / 3
    return places[:, :1] * a + places[:, 1:] * b + np.array([5, -3, 7])


def as_obj(points: Points) -> str:
    rows = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points.tolist())
    return f"{rows}f {' '.join(str(k + 1) for k in range(len(points)))}\n"


def as_ply(points: Points) -> str:
    head = ["ply", "format ascii 1.0", f"element vertex {len(points)}"]
    head += [f"property double {axis}" for axis in "xyz"]
    head += ["element face 1", "property list int int vertex_indices", "end_header"]
    rows = [f"{x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    return "\n".join([*head, *rows, " ".join(map(str, [len(points), *range(len(points))])), ""])


def read(folder: Path, points: Points, suffix: str) -> Mesh:
    path = folder / f"face.{suffix}"
    path.write_text({"obj": as_obj, "ply": as_ply}[suffix](points))
    return read_mesh(path)


def areas(points: Points, triangles: NDArray[np.integer]) -> Points:
    """Signed areas of triangles in a plane."""
    (ax, ay), (bx, by), (cx, cy) = (points[triangles[:, k]].T for k in range(3))
    return np.asarray((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2


@fewer
@pytest.mark.parametrize("suffix", ["obj", "ply"])
@pytest.mark.parametrize("turned", [1, -1])
@pytest.mark.parametrize(("points", "area"), SIMPLE.values(), ids=SIMPLE.keys())
def test_triangles_fill_a_polygon_once(
    tmp_path: Path, points: Points, area: float, turned: int, suffix: str
) -> None:
    """They are all turned as it is, and have its area: then they can't overlap. Whatever corner is the first."""
    for first in range(len(points)):
        flat = np.roll(points, first, axis=0)[::turned]
        mesh = read(tmp_path, tilted(flat), suffix)
        assert len(mesh.triangles) == len(points) - 2
        found = turned * areas(flat, mesh.triangles)
        assert found.min() > -1e-12
        assert found.sum() == pytest.approx(area, rel=1e-12)
        assert set(mesh.triangles.ravel().tolist()) == set(range(len(points)))


def test_corners_within_an_edge_are_corners_of_triangles(tmp_path: Path) -> None:
    """Else a neighbour that has them, too, would meet an edge between its corners, where rays may pass."""
    mesh = read(tmp_path, tilted(STRAIGHT), "obj")
    edges = {(int(t[k]), int(t[(k + 1) % 3])) for t in mesh.triangles for k in range(3)}
    assert {(k, (k + 1) % len(STRAIGHT)) for k in range(len(STRAIGHT))} <= edges


@pytest.mark.parametrize("points", CROSSED.values(), ids=CROSSED.keys())
def test_a_face_that_crosses_itself_is_told_by_its_line(tmp_path: Path, points: Points) -> None:
    with pytest.warns(
        CourseWarning, match=rf"line {len(points) + 1}: a face crosses itself or has"
    ):
        read(tmp_path, tilted(points), "obj")
    with pytest.warns(CourseWarning, match="face 0 crosses itself or has no area"):
        read(tmp_path, tilted(points), "ply")


def test_a_face_without_area_is_told(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nf 1 2 5\nf 1 2 3 4\nf 4 3 2 2\nf 1 1 1 1\n"
    )
    with pytest.warns(CourseWarning, match=r"line 7: a face and 2 more cross themselves or have"):
        read_mesh(tmp_path / "a.obj")


def test_faces_of_all_lengths_stand_in_their_places(tmp_path: Path) -> None:
    rows = [*U.tolist(), (10, 0), (11, 0), (11, 1), (10, 1)]
    text = "".join(f"v {x} {y} 0\n" for x, y in rows)
    (tmp_path / "a.obj").write_text(text + "f 9 10 11\nf 1 2 3 4 5 6 7 8\nf 9 10 11 12\n")
    mesh = read_mesh(tmp_path / "a.obj")
    found = areas(np.array(rows), mesh.triangles)
    assert found[:1].sum() == 0.5
    assert found[1:7].sum() == pytest.approx(7)
    assert found[7:9].sum() == 1


def star(count: int) -> Points:
    angle = np.arange(count) * (2 * math.pi / count)
    radius = np.where(np.arange(count) % 2, 1.0, 0.5)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


@pytest.mark.parametrize("count", [10, 300, 3000])
def test_stars_of_any_number_of_corners(count: int) -> None:
    points = star(count)
    found = cut(np.array([count]), np.arange(count), np.pad(points, ((0, 0), (0, 1))))
    assert not found.doubtful.size
    exact = count / 2 * 0.5 * math.sin(2 * math.pi / count)
    assert np.abs(areas(points, found.where)).sum() == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("count", [20, 90])
def test_both_ways_to_find_crossings_find_the_same(count: int) -> None:
    rng = np.random.default_rng(3)
    for _ in range(60):
        points = star(count)
        # A corner that goes far enough crosses other edges, or doesn't.
        points[rng.integers(count)] *= rng.uniform(-1.5, 1.5)
        assert _by_pairs(points) == _along_a_line(points)


def test_crossings_of_bridges_and_of_corners_that_touch_are_none() -> None:
    touching = np.array([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)], float)
    for points in (KEYHOLE, touching):
        assert not _by_pairs(points)
        assert not _along_a_line(points)


def test_a_face_of_very_many_corners_is_cut_soon(tmp_path: Path) -> None:
    """20,000 take a second; only a growth with their square, and more, would reach this bound."""
    begin = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mesh = read(tmp_path, tilted(star(20_000)), "obj")
    assert len(mesh.triangles) == 19_998
    assert time.process_time() - begin < 60
