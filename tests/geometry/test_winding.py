"""A file's normals say which side of its triangles is out, however these are wound."""

import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh

from course import shapes
from course.errors import CourseWarning
from course.formats.meshes.files import read_mesh, save_ply
from course.shapes.mesh import Mesh

QUAD = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvn 0 1 0\n"


def ball(turned: Callable[[int], bool]) -> Mesh:
    """A ball, some of whose triangles are wound the wrong way."""
    right = shapes.sphere(1.0, 24)
    triangles = right.triangles.copy()
    for number in range(len(triangles)):
        if turned(number):
            triangles[number] = triangles[number, ::-1]
    return Mesh(right.vertices, triangles, right.normals)


def ahead(mesh: Mesh) -> np.ndarray:
    """The triangles' own normals, times the mean of their corners'."""
    p0, p1, p2 = (mesh.vertices[mesh.triangles[:, corner]] for corner in range(3))
    assert mesh.normals is not None
    products: np.ndarray = np.sum(
        np.cross(p1 - p0, p2 - p0) * mesh.normals[mesh.triangles].mean(axis=1), axis=1
    )
    return products


def test_a_quad_against_its_normals_is_turned(tmp_path: Path) -> None:
    path = tmp_path / "quad.obj"
    path.write_text(QUAD + "f 4//1 3//1 2//1 1//1\n")
    with pytest.warns(CourseWarning, match=r"quad.obj: 2 of 2 triangles are wound against"):
        mesh = read_mesh(path)
    assert (ahead(mesh) > 0).all()


@pytest.mark.parametrize("every", [1, 3])
@pytest.mark.parametrize("suffix", ["ply", "obj", "glb"])
def test_a_ball_is_turned_where_it_is_wrong(tmp_path: Path, suffix: str, every: int) -> None:
    wrong = ball(lambda number: number % every == 0)
    path = tmp_path / f"ball.{suffix}"
    if suffix == "ply":
        save_ply(wrong, path)
    else:
        trimesh.Trimesh(
            wrong.vertices, wrong.triangles, vertex_normals=wrong.normals, process=False
        ).export(path, include_normals=True)
    with pytest.warns(CourseWarning, match="wound against"):
        mesh = read_mesh(path)
    products = ahead(mesh)
    assert (products[products != 0] > 0).all()


def test_what_agrees_is_left_alone(tmp_path: Path) -> None:
    right = ball(lambda _: False)
    path = tmp_path / "ball.ply"
    save_ply(right, path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mesh = read_mesh(path)
    np.testing.assert_array_equal(mesh.triangles, right.triangles)


def test_without_normals_the_winding_decides(tmp_path: Path) -> None:
    path = tmp_path / "quad.obj"
    path.write_text(QUAD.replace("vn 0 1 0\n", "") + "f 4 3 2 1\n")
    mesh = read_mesh(path)
    assert mesh.normals is not None
    assert (mesh.normals[:, 1] == -1).all()


def test_a_lit_floor_is_as_bright_either_way(tmp_path: Path) -> None:
    import course

    means = []
    for order in ("1//1 2//1 3//1 4//1", "4//1 3//1 2//1 1//1"):
        (tmp_path / "quad.obj").write_text(QUAD + f"f {order}\n")
        (tmp_path / "scene.yaml").write_text(
            "camera: {eye: [0, 3, 0.01], look_at: [0, 0, 0], vertical_fov: 10}\n"
            "film: {width: 4, height: 4}\n"
            "materials: {white: {color: 0.9}}\n"
            "lights: [{type: directional, direction: [0, -1, 0], irradiance: 1.57079632679}]\n"
            "objects: [{shape: mesh, file: quad.obj, material: white}]\n"
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", CourseWarning)
            picture = course.render(course.load_scene(tmp_path / "scene.yaml"))
        means.append(float(np.mean(picture.linear)))
    assert means[0] > 0
    assert means[0] == means[1]
