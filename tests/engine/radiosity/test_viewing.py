"""A solution doesn't depend on who looks at it, and shows what path tracing shows."""

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from course import load_scene, render
from course.base.errors import CourseError
from course.engine.core.accelerator import QueryStats
from course.engine.functions.effects import PROJECT
from course.engine.radiosity.radiosity import solve
from course.engine.radiosity.viewing import (
    Solution,
    View,
    flight,
    load_solution,
    look,
    own_view,
    radiance,
)
from course.engine.scene.building.cameras import make_camera

BOX = PROJECT / "scenes" / "radiosity.yaml"
SIZE = 64


@cache
def box() -> Solution:
    return solve(load_scene(BOX), patches=1500, tolerance=0.01)


def view(eye: tuple[float, float, float], look_at: tuple[float, float, float]) -> View:
    return View(np.array(eye), np.array(look_at), np.array((0.0, 1.0, 0.0)), 40.0)


def seen(picture_of: View, points: np.ndarray) -> np.ndarray:
    """(3, n) radiance of points of surfaces, by rays from a camera's eye to each of them; NaN where hidden."""
    solution = box()
    places = (points - solution.center[:, None]) / solution.scale
    eye = (picture_of.eye - solution.center) / solution.scale
    far = places - eye[:, None]
    distance = np.linalg.norm(far, axis=0)
    direction = (far / distance).astype(np.float32)
    found = solution.accelerator.intersect(eye.astype(np.float32)[:, None], direction, QueryStats())
    light = radiance(solution, found.triangle, found.u, found.v, direction)
    return np.where(np.abs(found.t - distance) < 1e-4, light, np.nan)


def test_a_point_has_the_same_radiance_for_all_cameras() -> None:
    """Points of the back wall and of the floor, from three eyes."""
    rng = np.random.default_rng(0)
    x, y = rng.uniform(-0.95, 0.95, (2, 400))
    points = np.concatenate(
        (np.stack((x, y + 1, np.full(400, -1.0))), np.stack((x, np.zeros(400), y))), axis=1
    )
    views = [view(eye, (0, 1, 0)) for eye in ((0.0, 1.0, 4.6), (0.9, 1.9, 0.9), (-0.8, 1.5, 0.6))]
    lights = [seen(v, points) for v in views]
    both = 0
    for other in lights[1:]:
        visible = ~np.isnan(lights[0][0]) & ~np.isnan(other[0])
        both += int(visible.sum())
        assert np.allclose(lights[0][:, visible], other[:, visible], rtol=2e-3, atol=1e-4)
    assert both > 400


def test_a_picture_shows_these_radiances() -> None:
    """Each pixel with one sample is the radiance of the point in its middle."""
    own = own_view(box())
    picture = look(box(), own, SIZE, SIZE, samples=1)
    camera = make_camera(
        own.eye, own.look_at - own.eye, own.up, math.radians(own.vertical_fov), SIZE, SIZE
    )
    x, y = (v.ravel().astype(np.float32) + 0.5 for v in np.meshgrid(np.arange(SIZE), range(SIZE)))
    direction = camera.directions(x, y).astype(float)
    # The back wall is the plane z = -1.
    points = own.eye[:, None] + direction * ((-1 - own.eye[2]) / direction[2])
    light = seen(own, points)
    wall = ~np.isnan(light[0])
    assert wall.sum() > 300
    assert np.allclose(picture.reshape(3, -1)[:, wall], light[:, wall], rtol=2e-3, atol=1e-4)


def test_light_between_corners_is_interpolated() -> None:
    """Corners as bright as they are far to the right, up and in front: so is every point."""
    solution = box()
    rng = np.random.default_rng(1)
    places = np.moveaxis(solution.vertices[solution.triangles], -1, 0) + 2
    turned = np.tile(places.transpose(0, 2, 1), 2)
    bright = replace(solution, corners=np.ascontiguousarray(turned))
    u, v = rng.random((2, 500), np.float32) / 2
    triangle = rng.integers(0, len(solution.triangles), 500).astype(np.int32)
    p0, p1, p2 = (solution.vertices[solution.triangles[triangle, k]].T for k in range(3))
    points = (1 - u - v) * p0 + u * p1 + v * p2
    light = radiance(bright, triangle, u, v, rng.standard_normal((3, 500)).astype(np.float32))
    assert np.allclose(light * math.pi, points + 2, atol=1e-5)


def test_it_is_what_path_tracing_finds() -> None:
    """2500 patches: the mean within 1%, squares of 8 x 8 pixels within 3% of it, root mean square.

    Noise takes no part in it: the paths' own error is under 1% in a square. Squares with a part of the lamp are
    left out, for the lamp's edge is as sharp as the pixels are.
    """
    scene = load_scene(BOX)
    solution = solve(scene, patches=2500, tolerance=0.002)
    paths = render(scene, size=(SIZE, SIZE), spp=256, seed=1).linear.transpose(2, 0, 1)
    mine = look(solution, own_view(solution), SIZE, SIZE)
    plain = (paths.max(axis=0) < 2).reshape(8, 8, 8, 8).all(axis=(1, 3))
    a, b = (p.reshape(3, 8, 8, 8, 8).mean(axis=(2, 4))[:, plain] for p in (paths, mine))
    assert plain.sum() > 50
    for channel in range(3):
        level = a[channel].mean()
        assert b[channel].mean() == pytest.approx(level, rel=0.01)
        assert np.sqrt(((a - b)[channel] ** 2).mean()) <= 0.03 * level


def test_a_solution_comes_back_from_its_file(tmp_path: Path) -> None:
    path = tmp_path / "box.npz"
    box().save(path)
    back = load_solution(path)
    assert (back.corners == box().corners).all()
    own = own_view(back)
    assert own.eye.tolist() == [0, 1, 4.6]
    picture = look(back, own, 16, 16)
    assert (picture == look(box(), own, 16, 16)).all()


def test_other_files_are_no_solutions(tmp_path: Path) -> None:
    path = tmp_path / "box.npz"
    with pytest.raises(CourseError, match=r"box\.npz: no such file"):
        load_solution(path)
    path.write_bytes(b"what")
    with pytest.raises(CourseError, match="can't be read: expected a solution that course radios"):
        load_solution(path)
    np.savez(path, corners=np.zeros(3))
    with pytest.raises(CourseError, match="no radiosity solution: expected"):
        load_solution(path)
    box().save(path)
    with np.load(path) as file:
        arrays = dict(file)
    for wrong in (
        {"triangles": arrays["triangles"] + 10**6},
        {"triangles": arrays["triangles"] + 0.5},
        {"vertices": arrays["vertices"] * np.nan},
        {"radiosity": arrays["radiosity"][:, 1:]},
        {"camera": np.full(10, np.nan)},
        {"scale": np.array("1")},
        {"size": arrays["size"] * 0},
        {"size": arrays["size"] + 10**6},
    ):
        np.savez(path, **{**arrays, **wrong})
        with pytest.raises(CourseError, match="no radiosity solution: expected"):
            load_solution(path)


def test_a_flight_goes_evenly_through_all_cameras() -> None:
    views = [view((0, 0, 4), (0, 0, 0)), view((0, 0, 2), (0, 0, 0)), view((1, 0, 2), (1, 0, 0))]
    path = flight(views, 7)
    eyes = np.array([v.eye for v in path])
    assert np.allclose(eyes[[0, -1]], [[0, 0, 4], [1, 0, 2]])
    steps = np.linalg.norm(np.diff(eyes, axis=0), axis=1)
    assert np.allclose(steps, 0.5, rtol=1e-2)
    assert (path[3].look_at == 0).all()
    turning = flight([view((0, 0, 4), (0, 0, 0)), view((0, 0, 4), (1, 0, 0))], 3)
    assert np.allclose(turning[1].look_at, [0.5, 0, 0])
    with pytest.raises(CourseError, match="two cameras and two frames"):
        flight(views[:1], 5)


def test_a_frame_that_sees_nothing_is_told_with_the_cameras_that_it_lies_between() -> None:
    left, front = view((-4, 0, 4), (0, 0, 0)), view((0, 0, 4), (0, 0, 0))
    behind = view((0, 0, -4), (0, 0, 0))
    between = r"\[0, 0, 4\] and \[0, 0, -4\]: the camera at \[0\.0, 0\.0, 0\.0\] looks at itself"
    # 4 units to the front, then 8 through the point that all look at; a frame every two.
    with pytest.raises(
        CourseError, match=f"^frame 4 of the flight, between the cameras at {between}"
    ):
        flight([left, front, behind], 7)
    with pytest.raises(CourseError, match="frame 1 of the flight"):
        flight([front, behind], 3)


def test_a_camera_has_to_look_somewhere() -> None:
    with pytest.raises(CourseError, match="looks at itself: give another point"):
        view((1, 2, 3), (1, 2, 3))
    with pytest.raises(CourseError, match="looks along its up"):
        view((0, 0, 0), (0, 1, 0))
