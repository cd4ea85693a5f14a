"""`Transformations` of cameras and lights: positions go as points, gaze and up as vectors, normals as normals."""

import numpy as np
import pytest

from tests.engine.formats.metu.conftest import Metu, Tree, tree

STEPS: Tree = {
    "Translation": {"_id": "1", "_data": "10 -3 2"},
    "Scaling": {"_id": "1", "_data": "2 3 0.5"},
    "Rotation": {"_id": "3", "_data": "90 0 0 2"},
}
STRETCHED = np.array([[0, -3, 0], [2, 0, 0], [0, 0, 0.5]])
"""s1 r3: (x, y, z) becomes (-3 y, 2 x, z / 2)."""
MOVE = np.array([10, -3, 2.0])


def unit(vector: np.ndarray) -> np.ndarray:
    return np.asarray(vector / np.linalg.norm(vector))


@pytest.mark.parametrize("aim", [{"Gaze": "0.4 -0.6 -2"}, {"GazePoint": "1.4 1.4 3"}])
def test_a_camera_goes_and_turns_with_its_steps(metu: Metu, aim: Tree) -> None:
    """The window and its distance stay what they are, though the gaze becomes another in length."""
    camera = {"Position": "1 2 5", "Up": "0.3 2 0.1", "Transformations": "s1 r3 t1"} | aim
    scene = tree(camera=camera, Transformations=STEPS)
    if "GazePoint" in aim:
        del scene["Cameras"]["Camera"]["Gaze"]
    got = metu.load(scene).loaded.description.camera
    eye = STRETCHED @ [1, 2, 5] + MOVE
    np.testing.assert_allclose(got.eye, eye, atol=1e-12)
    way = unit(np.array(got.look_at) - got.eye)
    np.testing.assert_allclose(way, unit(STRETCHED @ [0.4, -0.6, -2]), atol=1e-12)
    np.testing.assert_allclose(unit(np.array(got.up)), unit(STRETCHED @ [0.3, 2, 0.1]), atol=1e-12)
    assert got.image_plane is not None
    assert (got.image_plane.left, got.image_plane.distance) == (-1, 1)
    assert metu.warnings == []


def test_up_must_not_become_parallel_to_the_gaze(metu: Metu) -> None:
    """It may be so before its steps, which are no rotation: only what they make of it counts."""
    steps = {"Composite": {"_id": "1", "_data": "1 0 0 0  0 1 1 0  0 0 1 0  0 0 0 1"}}
    camera = {"Gaze": "0 -1 -1", "Up": "0 2 1", "Transformations": "c1"}
    got = metu.load(tree(camera=camera, Transformations=steps)).loaded.description.camera
    np.testing.assert_allclose(unit(np.array(got.up)), unit(np.array([0, 3, 1])))


def test_a_point_light_goes_where_its_steps_take_it(metu: Metu) -> None:
    light = {"_id": "1", "Position": "1 2 5", "Intensity": "9 9 9", "Transformations": "s1 r3 t1"}
    (got,) = metu.load(
        tree(lights={"PointLight": light}, Transformations=STEPS)
    ).loaded.description.lights
    np.testing.assert_allclose(got.position, STRETCHED @ [1, 2, 5] + MOVE, atol=1e-12)
    assert metu.warnings == []


def test_an_area_light_goes_and_turns_and_keeps_its_size(metu: Metu) -> None:
    light = {
        "_id": "1",
        "Position": "1 2 5",
        "Normal": "1 2 -3",
        "Size": "0.5",
        "Radiance": "9 9 9",
        "Transformations": "s1 r3 t1",
    }
    (got,) = metu.load(
        tree(lights={"AreaLight": light}, Transformations=STEPS)
    ).loaded.description.lights
    u, v = np.array(got.edge_u), np.array(got.edge_v)
    np.testing.assert_allclose(
        np.array(got.corner) + (u + v) / 2, STRETCHED @ [1, 2, 5] + MOVE, atol=1e-12
    )
    # By the inverse transpose of (-3 y, 2 x, z / 2): (-y / 3, x / 2, 2 z).
    np.testing.assert_allclose(unit(np.cross(u, v)), unit(np.array([-2 / 3, 0.5, -6])), atol=1e-12)
    np.testing.assert_allclose([np.linalg.norm(u), np.linalg.norm(v)], 0.5)
    assert abs(u @ v) < 1e-15
    assert metu.warnings == []
