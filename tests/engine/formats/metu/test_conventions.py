"""Conventions of METU scenes that this course's own scenes don't have, and what older files write in other ways."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.engine.formats.meshes.files import read_mesh, save_ply
from course.engine.shapes.mesh import Mesh
from tests.engine.formats.metu.conftest import MATT, Metu, Tree, tree

POINT = {"_id": "1", "Position": "3 0 0", "Intensity": "800 800 800"}
# Vertex 1 has a face of area 1/2 that looks along z, and one of area 3 that looks along x.
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 2, 0], [0, 0, 3]], float)
FACES = np.array([[0, 1, 2], [0, 3, 4]])


def of_corners(mode: str, faces: object) -> Tree:
    mesh = {"_id": "1", "Material": "1", "Faces": faces} | ({"_shadingMode": mode} if mode else {})
    vertices = " ".join(map(str, CORNERS.ravel()))
    return tree(vertices=vertices, objects={"Mesh": mesh})


def shown(metu: Metu, scene: Tree) -> np.ndarray | None:
    """Normals of the first object as they are shaded, None where it is flat."""
    loaded = metu.load(scene)
    thing = loaded.loaded.description.objects[0]
    if thing.shading == "flat":
        return None
    return read_mesh(loaded.path.parent / thing.file, thing.normals).normals


@pytest.mark.parametrize("form", ["inline", "file"])
def test_faces_count_in_smooth_normals_by_their_areas(
    metu: Metu, tmp_path: Path, form: str
) -> None:
    save_ply(Mesh(CORNERS, FACES), tmp_path / "two.ply")
    faces = {"_plyFile": "two.ply"} if form == "file" else "1 2 3 1 4 5"
    got = shown(metu, of_corners("smooth", faces))
    assert got is not None
    np.testing.assert_allclose(got[0], np.array([6, 0, 1]) / np.sqrt(37), rtol=1e-15)
    assert shown(metu, of_corners("", faces)) is None


@pytest.mark.parametrize(("mode", "smooth"), [("", True), ("smooth", True), ("flat", False)])
def test_a_file_with_normals_is_smooth_unless_it_is_to_be_flat(
    metu: Metu, tmp_path: Path, mode: str, smooth: bool
) -> None:
    own = np.eye(3)[[0, 1, 2, 0, 1]]
    save_ply(Mesh(CORNERS, FACES, own), tmp_path / "two.ply")
    got = shown(metu, of_corners(mode, {"_plyFile": "two.ply"}))
    assert (got is not None) == smooth
    if got is not None:
        np.testing.assert_array_equal(got, own)


def test_an_instance_is_as_smooth_as_its_base(metu: Metu, tmp_path: Path) -> None:
    save_ply(Mesh(CORNERS, FACES), tmp_path / "two.ply")
    scene = of_corners("smooth", {"_plyFile": "two.ply"})
    scene["Objects"]["MeshInstance"] = {"_id": "2", "_baseMeshId": "1"}
    base, copy = metu.load(scene).loaded.description.objects
    assert (copy.shading, copy.normals) == (base.shading, base.normals) == ("smooth", "area")


def test_without_a_depth_six_bounces_are_followed(metu: Metu) -> None:
    assert metu.load(tree()).loaded.description.integrator.max_depth == 6
    assert metu.load(tree(MaxRecursionDepth="0")).loaded.description.integrator.max_depth == 0


def test_every_light_is_asked_however_many_there_are(metu: Metu) -> None:
    lights = [POINT | {"_id": str(number), "Position": f"{number} 0 0"} for number in range(1, 71)]
    scene: Any = metu.load(tree(lights={"PointLight": lights}))
    assert len(scene.compiled.world.lights) == 70
    assert scene.compiled.world.choice is None


def test_directions_into_a_surface_are_kept_and_shadow_rays_start_at_facets(metu: Metu) -> None:
    rough = {"_id": "1", "_type": "mirror", "MirrorReflectance": "1 1 1", "Roughness": "0.5"}
    scene = metu.load(tree(materials=[rough], lights={"PointLight": POINT}))
    integrator = scene.loaded.description.integrator
    assert (integrator.into_surface, integrator.terminator) == ("keep", "facets")
    assert integrator.shading_normals == "interpolated"
    assert scene.compiled.world.keeps
    assert scene.compiled.world.surface.triangles.bulge is None


GLASS: Tree = {"_id": "2", "_type": "dielectric", "RefractionIndex": "1.5"}


@pytest.mark.parametrize("depth", ["0", "6"])
@pytest.mark.parametrize("faces", ["1 2 3 1 3 4", "1 3 2 1 4 3"], ids=["outside", "inside"])
def test_glass_shows_its_highlight_on_the_outside_alone(metu: Metu, faces: str, depth: str) -> None:
    """Where light comes at 36.9 degrees, straight to the viewer: cos^2 of half of it is 0.9, and I / d^2 is 32."""
    shiny = GLASS | {"SpecularReflectance": "1 0.5 0", "PhongExponent": "4"}
    scene = tree(
        materials=[MATT, shiny],
        lights={"PointLight": POINT},
        objects={"Mesh": {"_id": "1", "Material": "2", "Faces": faces}},
        MaxRecursionDepth=depth,
    )
    outside = 32 * 0.9**2 * np.array([1, 0.5, 0])
    expected = outside if faces.startswith("1 2") else 0 * outside
    np.testing.assert_allclose(metu.pixel(scene), expected, rtol=5e-5)


@pytest.mark.parametrize("faces", ["1 2 3 1 3 4", "1 3 2 1 4 3"], ids=["outside", "inside"])
def test_the_inside_of_glass_has_no_ambient_and_no_diffuse_light(metu: Metu, faces: str) -> None:
    grey = GLASS | {"AmbientReflectance": "0.5 0 0", "DiffuseReflectance": "0 0.5 0"}
    scene = tree(
        materials=[MATT, grey],
        lights={"AmbientLight": "100 0 0", "PointLight": POINT},
        objects={"Mesh": {"_id": "1", "Material": "2", "Faces": faces}},
    )
    expected = [50, 0.5 * 32 * 0.8, 0] if faces.startswith("1 2") else [0, 0, 0]
    np.testing.assert_allclose(metu.pixel(scene), expected, rtol=5e-5)


def test_a_reflectance_may_be_above_1(metu: Metu) -> None:
    bright = {"_id": "1", "AmbientReflectance": "0 2 0.5", "DiffuseReflectance": "0.5 0.5 1.5"}
    lights = {"AmbientLight": "100 100 100", "PointLight": POINT}
    got = metu.pixel(tree(materials=[bright], lights=lights))
    lit = 32 * 0.8 * np.array([0.5, 0.5, 1.5])
    np.testing.assert_allclose(got, lit + np.array([0, 200, 50]), rtol=5e-5)
    both = bright | {"AmbientReflectance": "0.5 0.5 1.5"}
    got = metu.pixel(tree(materials=[both], lights=lights))
    np.testing.assert_allclose(got, lit + np.array([50, 50, 150]), rtol=5e-5)


def test_of_five_numbers_of_a_near_plane_the_first_four_count(metu: Metu) -> None:
    scene = metu.load(tree(camera={"NearPlane": "-1 2 -3 4 5"}))
    plane = scene.loaded.description.camera.image_plane
    assert plane is not None
    assert (plane.left, plane.right, plane.bottom, plane.top) == (-1, 2, -3, 4)
    (warning,) = metu.warnings
    assert "NearPlane has 5 numbers: the first 4 are taken" in warning


@pytest.mark.parametrize(
    ("order", "corner"), [("xyz", [1, 2, 3]), ("zxy", [2, 3, 1]), ("yxz", [2, 1, 3])]
)
def test_vertices_may_come_in_another_order_of_axes(
    metu: Metu, order: str, corner: list[float]
) -> None:
    """Of zxy the first number is z, the second x, the third y."""
    mesh = {"_id": "1", "Material": "1", "Faces": {"_type": "triangle", "_data": "1 2 3"}}
    data = {"_type": order, "_data": "1 2 3  4 5 7  0 1 0"}
    nothing = "" if metu.form == "xml" else None
    scene = metu.load(tree(vertices=data, objects={"Mesh": mesh}, TexCoordData=nothing))  # type: ignore[arg-type]
    file = scene.loaded.description.objects[0].file
    assert read_mesh(scene.path.parent / file).vertices[0].tolist() == corner
    assert metu.warnings == []


def test_another_order_than_that_of_three_axes_is_refused(metu: Metu) -> None:
    data = {"_type": "xyw", "_data": "1 2 3"}
    with pytest.raises(Exception, match=r'VertexData: type is "xyw": expected the order of x, y'):
        metu.load(tree(vertices=data))  # type: ignore[arg-type]


def test_tables_with_something_in_them_are_still_named(metu: Metu) -> None:
    metu.load(tree(NormalData="0 1 0"))
    (warning,) = metu.warnings
    assert "Scene/NormalData is not known" in warning
