"""`VertexData` and `Faces`: the triangles of meshes that stand in the scene file, and the files of those that don't."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from course.core.triangles import Mesh
from course.core.types import Floats64, Indices
from course.errors import SceneError
from course.formats.meshes.smooth_normals import area_normals
from course.formats.metu.element import Element
from course.formats.yaml.document import show
from course.inputs import LARGEST_DATA, Bound, opened

LONGEST_HEADER = 1 << 16  # bytes


def read_vertices(scene: Element) -> Floats64:
    """The vertices of a scene, (V, 3) float64; none where it has no VertexData."""
    element = scene.maybe("VertexData")
    if element is None:
        return np.zeros((0, 3))
    axes = element.attribute("type") or "xyz"
    if sorted(axes) != ["x", "y", "z"]:
        raise element.error(f"type is {show(axes)}: expected the order of x, y and z, such as xyz")
    values = element.many("x, y and z of each vertex")
    if len(values) % 3:
        raise element.error(f"has {len(values)} numbers: expected three for each vertex")
    return values.reshape(-1, 3)[:, [axes.index(axis) for axis in "xyz"]]


def inline_mesh(faces: Element, vertices: Floats64, smooth: bool) -> Mesh:
    """The mesh of triples of vertex numbers, with only the vertices that it uses."""
    offset = vertex_offset(faces)
    corners = corners_of(faces, vertices, offset)
    used, triangles = np.unique(corners, return_inverse=True)
    triangles = triangles.reshape(-1, 3)
    own = vertices[used]
    return Mesh(own, triangles, area_normals(own, triangles) if smooth else None)


def vertex_offset(faces: Element) -> int:
    """What is added to each vertex number."""
    given = faces.attribute("vertexOffset") or "0"
    try:
        return int(given)
    except ValueError:
        raise faces.error(f"vertexOffset is {given!r}: expected a whole number") from None


def corners_of(element: Element, vertices: Floats64, offset: int = 0) -> Indices:
    """Triples of vertex numbers, counted from 1 in the file, as indices (T, 3)."""
    values = element.many("three vertex numbers for each triangle, such as 1 2 3")
    if len(values) == 0 or len(values) % 3 or (values != np.floor(values)).any():
        raise element.unexpected("three vertex numbers for each triangle, such as 1 2 3")
    check_indices(element, values + offset, vertices)
    return (values + offset).astype(np.intp).reshape(-1, 3) - 1


def check_indices(element: Element, numbers: Floats64, vertices: Floats64) -> None:
    """SceneError for a vertex number that VertexData doesn't have."""
    wrong = numbers[(numbers < 1) | (numbers > len(vertices))]
    if len(wrong):
        raise element.error(
            f"refers to vertex {wrong[0]:g}: expected numbers from 1 to {len(vertices)}, as VertexData has"
        )


def mesh_file(faces: Element, name: str, folder: Path) -> Path:
    """The file that Faces names; SceneError where there is none."""
    path = folder / name.replace("\\", "/")
    # Path.exists would raise an error of its own for a name that is too long.
    if not os.path.exists(path):  # noqa: PTH110
        raise faces.error(f"plyFile is {name}: no such file in {folder.resolve()}")
    if path.suffix.lower() != ".ply":
        raise faces.error(f"plyFile is {name}: expected a file that ends in .ply")
    return path


def has_normals(path: Path) -> bool:
    """Whether a PLY file has normals of its own."""
    with opened(path, "mesh file", Bound(LARGEST_DATA), SceneError) as stream:
        header = stream.read(LONGEST_HEADER).partition(b"end_header")[0]
    names = {line.split()[-1] for line in header.splitlines() if line.startswith(b"property ")}
    return {b"nx", b"ny", b"nz"} <= names
