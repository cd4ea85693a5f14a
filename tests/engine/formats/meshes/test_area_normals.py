"""Normals weighted by area: sums of cross products, by vertex number, worked out by hand."""

from pathlib import Path

import numpy as np
import pytest

from course.engine.formats.meshes.files import read_mesh, save_ply
from course.engine.formats.meshes.smooth_normals import area_normals, smooth_normals
from course.engine.shapes.mesh import Mesh

# At vertex 0 meet a right triangle of area 1/2 that looks along z, and one of area 3 that looks along x; their corners
# there are both right angles, so by angle they count alike.
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 2, 0], [0, 0, 3]], float)
FACES = np.array([[0, 1, 2], [0, 3, 4]])


def test_faces_count_by_their_areas() -> None:
    normals = area_normals(CORNERS, FACES)
    np.testing.assert_allclose(normals[0], np.array([6, 0, 1]) / np.sqrt(37), rtol=1e-15)
    np.testing.assert_array_equal(normals[1:3], [[0, 0, 1]] * 2)
    np.testing.assert_array_equal(normals[3:], [[1, 0, 0]] * 2)
    by_angle = smooth_normals(CORNERS, FACES)[0]
    np.testing.assert_allclose(by_angle, np.array([1, 0, 1]) / np.sqrt(2), rtol=1e-15)


@pytest.mark.parametrize("unit", [1e-170, 1e-40, 1e40, 1e149])
def test_the_unit_of_length_doesnt_count(unit: float) -> None:
    np.testing.assert_allclose(
        area_normals(CORNERS * unit, FACES), area_normals(CORNERS, FACES), rtol=1e-14
    )


def test_vertices_at_one_place_lend_each_other_nothing() -> None:
    """Two faces 10 degrees apart whose edge has four vertices: each face keeps its own normal."""
    tilt = np.radians(5)
    y = -np.tan(tilt)
    left, right = [[0, 0, -1], [-1, y, -1], [0, 0, 1]], [[0, 0, -1], [0, 0, 1], [1, y, -1]]
    normals = area_normals(np.array(left + right), np.arange(6).reshape(2, 3))
    own = [[-np.sin(tilt), np.cos(tilt), 0]] * 3 + [[np.sin(tilt), np.cos(tilt), 0]] * 3
    np.testing.assert_allclose(normals, own, atol=1e-15)


def test_normals_are_finite_without_area_and_where_faces_cancel() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 5, 5]], float)
    both_ways = np.array([[0, 1, 2], [2, 1, 0], [3, 3, 3]])
    normals = area_normals(vertices, both_ways)
    np.testing.assert_array_equal(np.abs(normals[:3]), [[0, 0, 1]] * 3)
    np.testing.assert_array_equal(normals[3], [0, 1, 0])


def test_a_file_without_normals_gets_those_that_are_asked_for(tmp_path: Path) -> None:
    save_ply(Mesh(CORNERS, FACES), tmp_path / "bare.ply")
    save_ply(Mesh(CORNERS, FACES, np.eye(3)[[0, 1, 2, 0, 1]]), tmp_path / "with.ply")
    bare = read_mesh(tmp_path / "bare.ply", "area").normals
    np.testing.assert_array_equal(bare, area_normals(CORNERS, FACES))
    usual = read_mesh(tmp_path / "bare.ply").normals
    np.testing.assert_array_equal(usual, smooth_normals(CORNERS, FACES))
    own = read_mesh(tmp_path / "with.ply", "area").normals
    np.testing.assert_array_equal(own, np.eye(3)[[0, 1, 2, 0, 1]])
