"""Cameras: image planes, near planes, lenses and samples, against the definitions worked out in float64."""

from dataclasses import replace

import numpy as np
import pytest

from course import Scene
from course.engine.scene.building.cameras import compile_camera
from tests.engine.formats.metu.conftest import MATT, Metu, Tree, tree

TILTED: Tree = {
    "Position": "1 2 5",
    "Gaze": "0.4 -0.6 -2",
    "Up": "0.3 2 0.1",
    "NearPlane": "-1 2 -0.5 1.5",
    "NearDistance": "1.5",
    "ImageResolution": "6 3",
}


def axes(camera: Tree, gaze: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The vectors u to the right, v up and w backwards; up need not be orthogonal to the gaze."""
    w = -gaze / np.linalg.norm(gaze)
    u = np.cross(np.array(camera["Up"].split(), float), w)
    u /= np.linalg.norm(u)
    return u, np.cross(w, u), w


def pixel_directions(scene: Scene, x: float, y: float) -> np.ndarray:
    """Unit directions (H, W, 3) through the same point of all pixels."""
    film = scene.loaded.description.film
    camera = compile_camera(scene.loaded, scene.compiled.frame, film.width, film.height)
    j, i = np.mgrid[: film.height, : film.width].astype(np.float32)
    rays = camera.directions((i + x).ravel().astype(np.float32), (j + y).ravel().astype(np.float32))
    return rays.T.reshape(film.height, film.width, 3).astype(float)


@pytest.mark.parametrize(("x", "y"), [(0.5, 0.5), (0.0, 0.25)])
def test_samples_lie_on_the_image_plane_row_0_on_top(metu: Metu, x: float, y: float) -> None:
    u, v, w = axes(TILTED, np.array([0.4, -0.6, -2]))
    left, right, bottom, top = -1, 2, -0.5, 1.5
    j, i = np.mgrid[:3, :6]
    s = left + (i + x) * (right - left) / 6
    t = top - (j + y) * (top - bottom) / 3
    expected = -1.5 * w + s[..., None] * u + t[..., None] * v
    expected /= np.linalg.norm(expected, axis=-1, keepdims=True)
    got = pixel_directions(metu.load(tree(camera=TILTED)), x, y)
    np.testing.assert_allclose(got, expected, atol=3e-7)


@pytest.mark.parametrize("lens", [{}, {"ApertureSize": "0.4", "FocusDistance": "7"}])
def test_the_axis_u_of_a_left_handed_camera_is_turned_round(metu: Metu, lens: Tree) -> None:
    u, v, w = axes(TILTED, np.array([0.4, -0.6, -2]))
    j, i = np.mgrid[:3, :6]
    s, t = -1 + (i + 0.5) * 3 / 6, 1.5 - (j + 0.5) * 2 / 3
    expected = -1.5 * w - s[..., None] * u + t[..., None] * v
    expected /= np.linalg.norm(expected, axis=-1, keepdims=True)
    scene = metu.load(tree(camera=TILTED | lens | {"_handedness": "left"}))
    np.testing.assert_allclose(pixel_directions(scene, 0.5, 0.5), expected, atol=3e-7)
    assert metu.warnings == []


@pytest.mark.parametrize("aim", [{"GazePoint": "1.4 1.4 3"}, {"Gaze": "0.4 -0.6 -2"}])
@pytest.mark.parametrize("kind", ["lookAt", "simple", ""])
def test_a_camera_without_near_plane_has_a_vertical_field_of_view(
    metu: Metu, aim: Tree, kind: str
) -> None:
    camera = {
        "_type": kind,
        "Position": "1 2 5",
        "Up": "0.3 2 0.1",
        "FovY": "70",
        "NearDistance": "1",
        "ImageResolution": "6 3",
        **aim,
    }
    scene = tree(camera=camera)
    if "GazePoint" in aim:
        del scene["Cameras"]["Camera"]["Gaze"]
    del scene["Cameras"]["Camera"]["NearPlane"]
    u, v, w = axes(camera, np.array([0.4, -0.6, -2]))
    half = np.tan(np.radians(35))
    j, i = np.mgrid[:3, :6]
    s, t = half * (i + 0.5 - 3) / 1.5, half * (1 - (j + 0.5) / 1.5)
    expected = -w + s[..., None] * u + t[..., None] * v
    expected /= np.linalg.norm(expected, axis=-1, keepdims=True)
    np.testing.assert_allclose(pixel_directions(metu.load(scene), 0.5, 0.5), expected, atol=3e-7)
    assert metu.warnings == []


def test_the_picture_is_not_mirrored(metu: Metu) -> None:
    """A small triangle to the right of and above the axis is in the picture's upper right quarter."""
    vertices = "0.2 0.2 -2  0.8 0.2 -2  0.5 0.8 -2"
    triangle = {"_id": "1", "Material": "1", "Indices": "1 2 3"}
    camera = {"ImageResolution": "8 8", "NearPlane": "-0.5 0.5 -0.5 0.5"}
    scene = tree(vertices=vertices, objects={"Triangle": triangle}, camera=camera)
    seen = metu.picture(scene)[..., 0] > 0
    assert seen[:4, 4:].any()
    assert not seen[4:].any()
    assert not seen[:, :4].any()


@pytest.mark.parametrize("distance", [0.5, 1.9, 2.1])
@pytest.mark.parametrize("lens", [{}, {"ApertureSize": "0.1", "FocusDistance": "4"}])
def test_what_is_nearer_than_the_image_plane_is_seen_too(
    metu: Metu, distance: float, lens: Tree
) -> None:
    near = " ".join(f"{x} {y} {-distance}" for x, y in ((-9, -9), (9, -9), (0, 9)))
    camera = {"NearPlane": "-2 2 -2 2", "NearDistance": "2", "ImageResolution": "7 7"} | lens
    dim = MATT | {"_id": "2", "AmbientReflectance": "0.5 0.5 0.5"}
    scene = tree(
        vertices=f"{near}  -99 -99 -5  99 -99 -5  0 99 -5",
        materials=[MATT, dim],
        objects={
            "Triangle": [
                {"_id": "1", "Material": "2", "Indices": "1 2 3"},
                {"_id": "2", "Material": "1", "Indices": "4 5 6"},
            ]
        },
        camera=camera,
    )
    np.testing.assert_allclose(metu.picture(scene), 50, rtol=1e-6)


def test_the_lens_is_a_square_whose_edge_is_the_aperture_size(metu: Metu) -> None:
    camera = TILTED | {"ApertureSize": "0.4", "FocusDistance": "7"}
    scene = metu.load(tree(camera=camera))
    frame, lens = scene.compiled.frame, scene.compiled.world.lens
    assert lens is not None
    built = compile_camera(scene.loaded, frame, 6, 3)
    u, v, w = axes(camera, np.array([0.4, -0.6, -2]))
    corners = np.array([[0, 0, 1, 1], [0, 1, 0, 1]], np.float32)
    # A picture point near a corner, the same for four points of the lens.
    x, y = np.full(4, 0.5, np.float32), np.full(4, 2.5, np.float32)
    pinhole = built.directions(x, y)
    origin, direction = replace(built, lens=lens).rays(x, y, corners, None)
    got = origin.T.astype(float) * frame.scale + frame.center
    expected = np.array([1, 2, 5]) + np.array(
        [0.4 * (a - 0.5) * u + 0.4 * (b - 0.5) * v for a, b in corners.T]
    )
    np.testing.assert_allclose(got, expected, atol=1e-5)
    # All of them meet in the plane at distance 7 along -w, where the pinhole's ray meets it too.
    one = pinhole[:, 0].astype(float)
    focus = np.array([1, 2, 5]) + one * (7 / -(one @ w))
    way = focus - expected
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    np.testing.assert_allclose(direction.T, way, atol=1e-5)


def test_an_aperture_of_0_is_a_pinhole(metu: Metu) -> None:
    assert metu.load(tree(camera={"ApertureSize": "0"})).compiled.world.lens is None


@pytest.mark.parametrize(
    ("given", "sampler", "samples"),
    [(None, "regular", 1), ("1", "regular", 1), ("4", "jittered", 4), ("36", "jittered", 36)],
)
def test_samples_are_a_jittered_grid_or_the_middle(
    metu: Metu, given: str | None, sampler: str, samples: int
) -> None:
    settings = metu.load(tree(camera={} if given is None else {"NumSamples": given})).settings
    assert (settings.sampler, settings.samples) == (sampler, samples)
    assert metu.warnings == []


@pytest.mark.parametrize(
    ("given", "taken"), [("2", 1), ("3", 4), ("40", 36), ("44", 49), ("56", 49), ("57", 64)]
)
def test_of_samples_that_are_no_square_the_nearest_grid_is_taken_and_that_is_said(
    metu: Metu, given: str, taken: int
) -> None:
    settings = metu.load(tree(camera={"NumSamples": given})).settings
    assert (settings.sampler, settings.samples) == ("jittered", taken)
    (warning,) = metu.warnings
    assert f"Scene/Cameras/Camera/NumSamples is {given}" in warning
    assert f"so {taken} are taken" in warning
