"""Smooth meshes under an uneven scaling: normals are interpolated as the mesh has them, and transformed then."""

from pathlib import Path

import numpy as np
import pytest

from tests.engine.formats.metu.conftest import Metu, Tree, tree

# The middle of the picture sees the centroid of a triangle, at (0, 0, -4) once it is stretched along z.
CORNERS = "-3 -2 -1  3 -2 -1  0 4 -1"
NORMALS = np.array([[0.6, 0, 0.8], [0, 0, 1], [0, 0.28, 0.96]])
STEPS: Tree = {
    "Translation": {"_id": "9", "_data": "0 0 50"},
    "Scaling": [{"_id": "1", "_data": "1 1 4"}, {"_id": "2", "_data": "-1 1 4"}],
    "Rotation": {"_id": "1", "_data": "130 0 0 1"},
    "Composite": {"_id": "1", "_data": "1 0 0 0  0 1 0 0  0 0 4 0  0 0 0 1"},
}
LIGHT = {"PointLight": {"_id": "1", "Position": "0 0 0", "Intensity": "800 800 800"}}


def ply() -> str:
    rows = np.concatenate((np.array(CORNERS.split(), float).reshape(3, 3), NORMALS), axis=1)
    header = "ply\nformat ascii 1.0\nelement vertex 3\n"
    header += "".join(f"property double {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
    header += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    return header + "".join(" ".join(map(str, row)) + "\n" for row in rows.tolist()) + "3 0 1 2\n"


@pytest.mark.parametrize("steps", ["s1", "c1", "s1 r1", "s2", "r1 s2"])
@pytest.mark.parametrize("through", ["mesh", "instance"])
def test_normals_of_vertices_are_interpolated_before_they_are_transformed(
    metu: Metu, tmp_path: Path, steps: str, through: str
) -> None:
    """Light from the eye: 800 / 4^2 times the cosine between the normal and the axis z, about which it is turned."""
    (tmp_path / "three.ply").write_text(ply(), encoding="utf-8")
    mesh = {"_id": "1", "Material": "1", "Faces": {"_plyFile": "three.ply"}}
    objects: Tree = {"Mesh": mesh | {"Transformations": steps}}
    if through == "instance":
        # Its base is out of sight, and stands as it is in the file: one mesh under two transformations.
        copy = {"_id": "2", "_baseMeshId": "1", "_resetTransform": "true", "Transformations": steps}
        objects = {"Mesh": mesh | {"Transformations": "t9"}, "MeshInstance": copy}
    scene = tree(vertices=CORNERS, objects=objects, lights=LIGHT, Transformations=STEPS)
    normal = NORMALS.mean(axis=0) / [1, 1, 4]
    cosine = normal[2] / np.linalg.norm(normal)
    np.testing.assert_allclose(metu.pixel(scene), 50 * cosine * np.array([1, 0.5, 0]), rtol=3e-5)
    assert metu.warnings == []


def test_normals_that_come_from_the_faces_are_those_of_the_faces_before(metu: Metu) -> None:
    """A tent of three faces about the tip that the picture shows nearly; all in the scene itself."""
    vertices = "-3 -2 -1.5  3 -2 -1.25  0 4 -2  0 0 -1"
    mesh = {"_id": "1", "_shadingMode": "smooth", "Material": "1", "Transformations": "s1"}
    objects = {"Mesh": mesh | {"Faces": "1 2 4 2 3 4 3 1 4"}}
    # The light and the eye see the face of vertices 1, 2 and 4 at weights 1/4, 1/4 and 1/2, where y is -1.
    corners = np.array(vertices.split(), float).reshape(4, 3)
    faces = np.array([[0, 1, 3], [1, 2, 3], [2, 0, 3]])
    p = corners[faces]
    crossed = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    own = np.zeros((4, 3))
    for face, normal in zip(faces, crossed, strict=True):
        own[face] += normal
    own /= np.linalg.norm(own, axis=1, keepdims=True)
    weights = np.array([0.25, 0.25, 0, 0.5])
    point, normal = weights @ corners * [1, 1, 4], weights @ own / [1, 1, 4]
    camera = {"Gaze": " ".join(map(repr, point.tolist())), "NearPlane": "-.001 .001 -.001 .001"}
    scene = tree(
        vertices=vertices, objects=objects, lights=LIGHT, camera=camera, Transformations=STEPS
    )
    expected = 800 * -(point @ normal) / np.linalg.norm(normal) / np.linalg.norm(point) ** 3
    np.testing.assert_allclose(metu.pixel(scene), expected * np.array([1, 0.5, 0]), rtol=1e-4)
