"""A file's normals say which side of its triangles is out, however these are wound."""

import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh

from course.base.errors import CourseWarning
from course.engine import shapes
from course.engine.formats.meshes.files import read_mesh, save_ply
from course.engine.shapes.mesh import Mesh

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


@pytest.mark.parametrize("text", [False, True])
def test_an_stl_files_facets_say_where_out_is(tmp_path: Path, text: bool) -> None:
    right = trimesh.Trimesh(ball(lambda _: False).vertices, ball(lambda _: False).triangles)
    wound = right.faces.copy()
    wound[::3] = wound[::3, ::-1]
    path = tmp_path / "ball.stl"
    as_stl(path, right.vertices[wound], right.face_normals, text)
    with pytest.warns(CourseWarning, match="wound against"):
        mesh = read_mesh(path)
    centers = mesh.vertices[mesh.triangles].mean(axis=1)
    p0, p1, p2 = (mesh.vertices[mesh.triangles[:, corner]] for corner in range(3))
    assert (np.sum(np.cross(p1 - p0, p2 - p0) * centers, axis=1) > 0).all()


@pytest.mark.parametrize("facet", [(0, 0, 0), (0, 0, 1), (np.nan, 0, 1)])
def test_facets_that_are_no_normals_say_nothing(
    tmp_path: Path, facet: tuple[float, float, float]
) -> None:
    right = ball(lambda _: False)
    path = tmp_path / "ball.stl"
    corners = right.vertices[right.triangles]
    as_stl(path, corners, np.array([facet] * len(corners)), False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mesh = read_mesh(path)
    assert (ahead(mesh) >= 0).all()


def as_stl(path: Path, corners: np.ndarray, facets: np.ndarray, text: bool) -> None:
    """Write triangles (T, 3, 3) with their facets' normals (T, 3)."""
    if not text:
        rows = np.zeros(
            len(corners), [("facet", "<f4", 3), ("corners", "<f4", (3, 3)), ("a", "<u2")]
        )
        rows["facet"], rows["corners"] = facets, corners
        path.write_bytes(bytes(80) + np.uint32(len(rows)).tobytes() + rows.tobytes())
        return
    lines = ["solid ball"]
    for facet, triangle in zip(facets, corners, strict=True):
        vertices = (f"vertex {x} {y} {z}" for x, y, z in triangle)
        x, y, z = facet
        lines += [f"facet normal {x} {y} {z}", "outer loop", *vertices, "endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid ball", ""]))


@pytest.mark.parametrize("far", [0.0, 4e6])
def test_what_lies_far_away_is_turned_too(tmp_path: Path, far: float) -> None:
    """Its corners are told to half of its size only, and still it can't look the other way."""
    names = [(name, "<f4") for name in ("x", "y", "z", "nx", "ny", "nz")]
    rows = [(far - 1, 0, 1), (far + 1, 0, 1), (far + 1, 0, -1), (far - 1, 0, -1)]
    vertices = np.array([(*row, 0, 1, 0) for row in rows], names)
    faces = np.array([(3, (2, 1, 0)), (3, (3, 2, 0))], [("n", "u1"), ("v", "<i4", 3)])
    header = ["ply", "format binary_little_endian 1.0", "element vertex 4"]
    header += [f"property float {name}" for name, _ in names]
    header += ["element face 2", "property list uchar int vertex_indices", "end_header", ""]
    path = tmp_path / "quad.ply"
    path.write_bytes("\n".join(header).encode() + vertices.tobytes() + faces.tobytes())
    with pytest.warns(CourseWarning, match="2 of 2 triangles"):
        assert (ahead(read_mesh(path)) > 0).all()


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
