"""Infinite planes: where they are, how far they reach, and that nothing else loses by them."""

import numpy as np
import pytest

from course.engine.formats.meshes.files import read_mesh
from course.engine.scene.building.objects import object_mesh
from tests.engine.formats.metu.conftest import Metu, Tree, tree

FLOOR: Tree = {"_id": "1", "Material": "1", "Point": "1", "Normal": "0 2 0"}
VERTICES = "3 -1 7   -1 -1 -5  1 -1 -5  0 0.5 -5"
BLOCKER: Tree = {"_id": "2", "Material": "1", "Indices": "2 3 4"}
WIDE: Tree = {"NearPlane": "-1 1 -1 1", "ImageResolution": "64 400"}


def with_floor(**others: object) -> Tree:
    return tree(
        vertices=VERTICES,
        objects={"Plane": FLOOR, "Triangle": BLOCKER},
        camera=WIDE,
        **others,  # type: ignore[arg-type]
    )


def test_the_floor_reaches_the_horizon_and_no_farther(metu: Metu) -> None:
    """The camera looks along the horizon, from 1 above the floor: the lower half is floor, to the row."""
    picture = metu.picture(with_floor(BackgroundColor="0 0 9"))
    np.testing.assert_allclose(picture[200:, 0], [[100, 100, 100]] * 200, rtol=1e-6)
    np.testing.assert_array_equal(picture[:200, 0], [[0, 0, 9]] * 200)
    assert metu.warnings == []


def test_light_and_shadow_on_a_floor_are_those_of_a_small_one(metu: Metu) -> None:
    """Irradiance of a point light on the rows below the triangle, and its shadow behind it, as on a quad nearby."""
    light = {"PointLight": {"_id": "1", "Position": "0 2 0", "Intensity": "900 900 900"}}
    scene = with_floor(lights=light)
    far = metu.picture(scene)
    scene["VertexData"] += "  -20 -1 20  20 -1 20  20 -1 -20  -20 -1 -20"
    scene["Objects"] = {
        "Mesh": {"_id": "1", "Material": "1", "Faces": "5 6 7 5 7 8"},
        "Triangle": BLOCKER,
    }
    near = metu.picture(scene)
    below = slice(250, 400)
    np.testing.assert_allclose(far[below], near[below], rtol=1e-4)
    # Up to the far edge of the small one: but for a pixel or so along the shadow's edge all are the same.
    same = np.isclose(far[212:250], near[212:250], rtol=1e-3).all(axis=-1)
    assert same.mean() > 0.995
    # The last row's middle: at depth 1, straight below the image's lower edge.
    y = 1 - 2 * 399.5 / 400
    at = np.array([0, -1, 1 / y])
    way = np.array([0, 2, 0]) - at
    expected = 900 * way[1] / np.linalg.norm(way) ** 3
    x = 2 * 32.5 / 64 - 1
    at[0] = x / -y
    np.testing.assert_allclose(far[399, 32, 0], expected, rtol=2e-3)


@pytest.mark.parametrize("motion", [{}, {"MotionBlur": "0 0 -50"}])
def test_a_plane_is_moved_and_its_normal_goes_by_the_inverse_transpose(
    metu: Metu, motion: Tree
) -> None:
    """The plane x + y = const, stretched by 2 along x, is x / 2 + y = const, through the vertex's image."""
    steps = {
        "Scaling": {"_id": "1", "_data": "2 1 1"},
        "Translation": {"_id": "1", "_data": "0 0 4"},
    }
    plane = FLOOR | {"Normal": "1 1 0", "Transformations": "s1 t1"}
    triangle = BLOCKER | motion
    objects = {"Plane": plane, "Triangle": triangle}
    scene = metu.load(tree(vertices=VERTICES, objects=objects, Transformations=steps))
    loaded = scene.loaded
    number = len(loaded.description.objects) - 1
    mesh = object_mesh(
        loaded.description.objects[number], number, loaded.document, scene.path.parent
    )
    offsets = mesh.vertices @ [0.5, 1, 0]
    size = np.abs(mesh.vertices).max()
    np.testing.assert_allclose(offsets, 6 * 0.5 - 1, atol=1e-12 * size)
    p = mesh.vertices[mesh.triangles]
    crossed = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    crossed /= np.linalg.norm(crossed, axis=1, keepdims=True)
    np.testing.assert_allclose(crossed, [np.array([0.5, 1, 0]) / np.sqrt(1.25)] * len(p), atol=1e-9)
    # 4096 times as far as anything else, where it moves to as well.
    farthest = 50 if motion else 5
    assert size > 4096 * farthest / 2


def test_a_plane_lies_about_the_rest_of_the_scene_wherever_its_point_is(metu: Metu) -> None:
    """The compiled scene's unit is no larger for it, and so are the digits that are left to all else."""
    near = metu.load(with_floor()).compiled.frame
    scene = with_floor()
    scene["VertexData"] = scene["VertexData"].replace("3 -1 7", "3e6 -1 7e6")
    far = metu.load(scene).compiled.frame
    np.testing.assert_allclose(far.scale, near.scale)
    np.testing.assert_allclose(far.center, near.center, atol=1e-9 * near.scale)
    # The camera and the triangle are within 4 of their middle, which is 0.25 above it.
    assert near.scale < 4096 * 5


def test_rings_fit_without_gaps(metu: Metu) -> None:
    """Every inner edge has two triangles, in opposite order, and the outer square's edges have one."""
    scene = metu.load(with_floor())
    thing = scene.loaded.description.objects[-1]
    triangles = read_mesh(scene.path.parent / thing.file).triangles
    edges = [(t[k], t[(k + 1) % 3]) for t in triangles.tolist() for k in range(3)]
    assert len(set(edges)) == len(edges)
    single = [edge for edge in edges if edge[::-1] not in set(edges)]
    assert len(single) == 4


def test_a_plane_alone_is_a_scene(metu: Metu) -> None:
    scene = tree(
        vertices="0 -1 0", objects={"Plane": FLOOR}, camera={"Gaze": "0 -1 0", "Up": "0 0 1"}
    )
    scene["Cameras"]["Camera"]["NearDistance"] = "0.5"
    np.testing.assert_allclose(metu.pixel(scene), 100, rtol=1e-6)
