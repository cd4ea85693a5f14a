"""Meshes, instances, spheres, triangles: where they end up, which way their normals look, how they move."""

import math
from pathlib import Path

import numpy as np
import pytest

from course import Scene
from course.base.errors import SceneError
from course.engine.formats.meshes.files import read_mesh
from course.engine.scene.building.objects import object_mesh
from tests.engine.formats.metu.conftest import MATT, Metu, Tree, tree

STEPS: Tree = {
    "Translation": [{"_id": "1", "_data": "10 0 0"}, {"_id": "2", "_data": "0 0 5"}],
    "Scaling": {"_id": "1", "_data": "2 3 1"},
    "Rotation": {"_id": "3", "_data": "90 0 0 2"},
    "Composite": {"_id": "1", "_data": "0 -1 0 7  1 0 0 0  0 0 2 -3  0 0 0 1"},
}
FACES = "1 2 3"
TRIANGLE = "1 0 0  2 0 0  1 1 0"


def vertices_of(scene: Scene, number: int) -> np.ndarray:
    loaded = scene.loaded
    thing = loaded.description.objects[number]
    return object_mesh(thing, number, loaded.document, loaded.path.parent).vertices


def one_mesh(transformations: str, **keys: object) -> Tree:
    mesh = {"_id": "1", "Material": "1", "Transformations": transformations, "Faces": FACES}
    return tree(vertices=TRIANGLE, objects={"Mesh": mesh | keys}, Transformations=STEPS)


@pytest.mark.parametrize(
    ("names", "corner"),
    [
        ("", [1, 0, 0]),
        ("t1 r3 s1", [0, 33, 0]),
        ("s1 r3 t1", [10, 2, 0]),
        ("r3 s1 t1 t2", [10, 3, 5]),
        (" r3\n r3 ", [-1, 0, 0]),
        # Its rows: to 7 - y, x, 2 z - 3.
        ("c1", [7, 1, -3]),
        ("t1 c1 s1", [14, 33, -3]),
        ("c1 c1", [6, 7, -9]),
    ],
)
def test_steps_apply_from_left_to_right(metu: Metu, names: str, corner: list[float]) -> None:
    """(1, 0, 0): moved by 10 along x, turned to y, scaled by 3; and so on."""
    got = vertices_of(metu.load(one_mesh(names)), 0)[0]
    np.testing.assert_allclose(got, corner, atol=1e-12)


def with_instances(*instances: Tree) -> Tree:
    scene = one_mesh("t1")
    scene["Objects"]["MeshInstance"] = list(instances)
    return scene


def instance(number: int, base: int, **keys: str) -> Tree:
    return {"_id": str(number), "_baseMeshId": str(base), "Material": "1", **keys}


@pytest.mark.parametrize(
    ("reset", "corner"), [(None, [0, 11, 0]), ("false", [0, 11, 0]), ("true", [0, 1, 0])]
)
def test_an_instance_goes_on_from_its_base_unless_it_is_reset(
    metu: Metu, reset: str | None, corner: list[float]
) -> None:
    keys = {} if reset is None else {"_resetTransform": reset}
    scene = metu.load(with_instances(instance(2, 1, Transformations="r3", **keys)))
    np.testing.assert_allclose(vertices_of(scene, 1)[0], corner, atol=1e-12)
    np.testing.assert_allclose(vertices_of(scene, 0)[0], [11, 0, 0])
    base, copy = scene.loaded.description.objects
    assert base.file == copy.file


def test_instances_of_instances_in_any_order(metu: Metu) -> None:
    later = instance(3, 2, Transformations="t2")
    scene = metu.load(with_instances(later, instance(2, 1, Transformations="r3")))
    np.testing.assert_allclose(vertices_of(scene, 1)[0], [0, 11, 5], atol=1e-12)
    np.testing.assert_allclose(vertices_of(scene, 2)[0], [0, 11, 0], atol=1e-12)


def test_an_id_of_two_instances_is_told_where_a_base_is_missing(metu: Metu) -> None:
    """One of the two was probably to have the id that is missed."""
    scene = with_instances(instance(5, 1), instance(5, 1), instance(7, 6))
    told = r'baseMeshId is "6": expected .*; the id "5" is given to 2 instances'
    with pytest.raises(SceneError, match=told):
        metu.load(scene)


def test_a_base_that_two_instances_could_be_is_told(metu: Metu) -> None:
    moved = instance(5, 1, Transformations="t2")
    scene = metu.load(with_instances(instance(5, 1), moved, instance(7, 5)))
    np.testing.assert_allclose(vertices_of(scene, 3)[0], [11, 0, 0])
    (warning,) = metu.warnings
    assert "MeshInstance[3] has baseMeshId 5, an id that 2 instances have" in warning
    # Meshes and instances may be counted apart, and nobody asks for the second.
    metu.load(with_instances(instance(1, 1), instance(1, 1)))
    assert metu.warnings == []


def test_an_instance_has_a_material_of_its_own_or_its_bases(metu: Metu) -> None:
    scene = with_instances(instance(2, 1, Material="7"), {"_id": "3", "_baseMeshId": "2"})
    scene["Materials"]["Material"].append(MATT | {"_id": "7"})
    names = [thing.material for thing in metu.load(scene).loaded.description.objects]
    assert names == ["material 1", "material 7", "material 7"]


@pytest.mark.parametrize(
    ("own", "velocity"), [(None, (0, 0, 0)), ("0 3 0", (0, 3, 0)), ("0 0 0", (0, 0, 0))]
)
@pytest.mark.parametrize("reset", ["false", "true"])
def test_an_instance_moves_only_if_it_says_so_itself(
    metu: Metu, own: str | None, velocity: tuple[float, ...], reset: str
) -> None:
    """Whatever its base does, an instance too, and whether its transformation is reset or not."""
    keys = {} if own is None else {"MotionBlur": own}
    scene = one_mesh("t1", MotionBlur="2 0 1")
    moving = instance(2, 1, _resetTransform=reset, **keys)
    scene["Objects"]["MeshInstance"] = [moving, instance(3, 2)]
    things = metu.load(scene).loaded.description.objects
    assert [thing.motion.velocity for thing in things] == [(2, 0, 1), velocity, (0, 0, 0)]


def test_a_sphere_is_stretched_after_it_is_put_at_its_vertex(metu: Metu) -> None:
    sphere = {
        "_id": "1",
        "Material": "1",
        "Center": "2",
        "Radius": "0.5",
        "Transformations": "s1 t2",
    }
    scene = metu.load(tree(vertices=TRIANGLE, objects={"Sphere": sphere}, Transformations=STEPS))
    loaded = scene.loaded
    mesh = object_mesh(loaded.description.objects[0], 0, loaded.document, loaded.path.parent)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    # About (2, 0, 0), scaled by 2 3 1 about the origin, moved by 5 along z.
    np.testing.assert_allclose([low, high], [[3, -1.5, 4.5], [5, 1.5, 5.5]], atol=1e-9)
    assert mesh.normals is not None
    # The gradient of x^2 / 1 + y^2 / 1.5^2 + z^2 / 0.5^2 about the middle.
    # Its length is 2 along z, where it is longest, and 2 / 3 along y.
    gradient = (mesh.vertices - [4, 0, 5]) / np.array([1, 2.25, 0.25])
    np.testing.assert_allclose(mesh.normals, gradient / 2, atol=1e-9)


@pytest.mark.parametrize("mode", ["flat", "smooth"])
def test_smooth_normals_are_shared_by_vertex_number(metu: Metu, mode: str) -> None:
    """A roof of two faces, at 90 degrees: along the ridge the mean of both, for flat shading none."""
    vertices = "0 1 -1  0 1 1  -1 0 -1  1 0 -1"
    mesh = {"_id": "1", "_shadingMode": mode, "Material": "1", "Faces": "1 3 2 1 2 4"}
    scene = metu.load(tree(vertices=vertices, objects={"Mesh": mesh}))
    loaded = scene.loaded
    got = object_mesh(loaded.description.objects[0], 0, loaded.document, loaded.path.parent)
    if mode == "flat":
        assert got.normals is None
        return
    assert got.normals is not None
    order = {tuple(v): n for v, n in zip(got.vertices.tolist(), got.normals, strict=True)}
    side = math.sqrt(0.5)
    np.testing.assert_allclose(order[0, 1, 1], [0, 1, 0], atol=1e-12)
    np.testing.assert_allclose(order[-1, 0, -1], [-side, side, 0], atol=1e-12)
    np.testing.assert_allclose(order[1, 0, -1], [side, side, 0], atol=1e-12)


def test_vertices_at_one_place_with_two_numbers_stay_a_crease(metu: Metu) -> None:
    """Two faces 20 degrees apart whose ridge has four vertices: each keeps its own normal."""
    tilt = math.radians(10)
    y = -math.tan(tilt)
    vertices = f"0 0 -1  0 0 1  -1 {y} -1   0 0 -1  0 0 1  1 {y} -1"
    mesh = {"_id": "1", "_shadingMode": "smooth", "Material": "1", "Faces": "1 3 2 4 5 6"}
    scene = metu.load(tree(vertices=vertices, objects={"Mesh": mesh}))
    got = read_mesh(scene.path.parent / scene.loaded.description.objects[0].file).normals
    assert got is not None
    left, right = [-math.sin(tilt), math.cos(tilt), 0], [math.sin(tilt), math.cos(tilt), 0]
    np.testing.assert_allclose(got, [left] * 3 + [right] * 3, atol=1e-12)


def test_an_offset_is_added_to_vertex_numbers(metu: Metu) -> None:
    faces = {"_vertexOffset": "3", "_data": "1 2 3"}
    mesh = {"_id": "1", "Material": "1", "Faces": faces}
    scene = tree(vertices=f"9 9 9 8 8 8 7 7 7 {TRIANGLE}", objects={"Mesh": mesh})
    np.testing.assert_array_equal(
        vertices_of(metu.load(scene), 0), [[1, 0, 0], [2, 0, 0], [1, 1, 0]]
    )


PLY = (
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n4 0 0\n0 5 0\n3 0 1 2\n"
)


def test_a_mesh_file_is_read_from_where_it_lies(metu: Metu, tmp_path: Path) -> None:
    (tmp_path / "ply").mkdir()
    (tmp_path / "ply" / "one.ply").write_text(PLY)
    mesh = {"_id": "1", "Material": "1", "Faces": {"_plyFile": "ply/one.ply"}}
    scene = metu.load(tree(vertices="", objects={"Mesh": mesh}))
    np.testing.assert_array_equal(vertices_of(scene, 0), [[0, 0, 0], [4, 0, 0], [0, 5, 0]])
    assert scene.loaded.description.objects[0].file == "ply/one.ply"


@pytest.mark.parametrize("offset", ["0", "3"])
def test_an_offset_beside_a_mesh_file_adds_nothing_and_that_is_said(
    metu: Metu, tmp_path: Path, offset: str
) -> None:
    """The file has three vertices, and three more stand in the scene."""
    (tmp_path / "one.ply").write_text(PLY)
    faces = {"_plyFile": "one.ply", "_vertexOffset": offset}
    mesh = {"_id": "1", "Material": "1", "Faces": faces}
    scene = metu.load(tree(vertices=TRIANGLE, objects={"Mesh": mesh}))
    np.testing.assert_array_equal(vertices_of(scene, 0), [[0, 0, 0], [4, 0, 0], [0, 5, 0]])
    if offset == "0":
        assert metu.warnings == []
        return
    (warning,) = metu.warnings
    assert "Scene/Objects/Mesh/Faces has vertexOffset 3, which counts only for vertex" in warning


def test_an_offset_beside_a_mesh_file_is_a_whole_number(metu: Metu, tmp_path: Path) -> None:
    (tmp_path / "one.ply").write_text(PLY)
    faces = {"_plyFile": "one.ply", "_vertexOffset": "three"}
    mesh = {"_id": "1", "Material": "1", "Faces": faces}
    with pytest.raises(SceneError, match="vertexOffset is 'three': expected a whole number"):
        metu.load(tree(vertices=TRIANGLE, objects={"Mesh": mesh}))


def test_written_meshes_keep_every_bit(metu: Metu) -> None:
    third = repr(1 / 3)
    scene = metu.load(
        tree(
            vertices=f"{third} 1e8 0  2 1e-9 0  1 1 0.1",
            objects={"Mesh": {"_id": "1", "Material": "1", "Faces": FACES}},
        )
    )
    file = scene.path.parent / scene.loaded.description.objects[0].file
    assert read_mesh(file).vertices[0].tolist() == [1 / 3, 1e8, 0]
    assert read_mesh(file).vertices[1].tolist() == [2, 1e-9, 0]


def test_triangles_of_one_kind_make_one_mesh(metu: Metu) -> None:
    triangles = [
        {"_id": "1", "Material": "1", "Indices": "1 2 3"},
        {"_id": "2", "Material": "1", "Indices": "1 3 4"},
        {"_id": "3", "Material": "1", "Indices": "1 2 3", "Transformations": "t1"},
    ]
    scene = metu.load(tree(objects={"Triangle": triangles}, Transformations=STEPS))
    assert scene.compiled.triangles == (2, 1)


def test_blur_is_a_displacement_in_the_world_whatever_the_transform(metu: Metu) -> None:
    """A square that fills both pixels leaves to the right: of the left one it covers 1/4 on average, of the other 3/4.

    Were it turned with the object, it would leave upwards and cover half of both. Each mean of 4096 jittered samples
    is a share with a standard error below 0.008: seven of them fail once in 10^11.
    """
    square = "-1 -0.5 -1  1 -0.5 -1  1 0.5 -1  -1 0.5 -1"
    turned = " ".join(str(v) for v in (0.5, 1, -1, 0.5, -1, -1, -0.5, -1, -1, -0.5, 1, -1))
    assert square != turned
    mesh = {
        "_id": "1",
        "Material": "1",
        "Transformations": "r3",
        "MotionBlur": "2 0 0",
        "Faces": "3 2 1 4 3 1",
    }
    camera = {
        "NearPlane": "-1 1 -0.5 0.5",
        "NearDistance": "0.9999",
        "ImageResolution": "2 1",
        "NumSamples": "4096",
    }
    scene = tree(vertices=turned, objects={"Mesh": mesh}, camera=camera, Transformations=STEPS)
    picture = metu.picture(scene)[0, :, 0] / 100
    np.testing.assert_allclose(picture, [0.25, 0.75], atol=7 * 0.008)
