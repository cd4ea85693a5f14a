"""Direct light against closed forms, worked out in float64 from the scene's own numbers.

Pictures of one regular sample a pixel look through the middles of the pixels, so each pixel has an answer. Shadow rays
leave from 2^-19 of the half extent above the surface, at a distance of about the half extent from the light, so the
tolerance of these is 1e-4. Lights that have a size are in tests/engine/core/test_soft_shadows.py.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from tests.conftest import MakeScene, PixelRays

pytestmark = pytest.mark.usefixtures("each_form")

Array = NDArray[np.float64]

FLOOR = {"shape": "quad", "material": "grey", "width": 6, "depth": 6}
CAMERA = {"eye": [0.4, 2, 1.5], "look_at": [0, 0, -0.2], "vertical_fov": 40}
ONE = {"type": "regular", "samples": 1}
COLOR = np.array([0.9, 0.5, 0.2])


@pytest.fixture
def floor(make_scene: MakeScene) -> MakeScene:
    """A floor that fills the picture, one sample a pixel."""

    def make(light: dict[str, Any] | list[dict[str, Any]], **material: Any) -> Scene:
        return make_scene(
            camera=CAMERA,
            film={"width": 48, "height": 36},
            sampler=ONE,
            objects=[FLOOR],
            lights=light if isinstance(light, list) else [light],
            materials={"grey": {"color": COLOR.tolist()} | material},
        )

    return make


@pytest.fixture
def on_floor(pixel_rays: PixelRays) -> Callable[[Scene], tuple[Array, Array]]:
    """Where the pixels' rays meet the floor, and the directions back to the viewer, (3, H, W) each."""

    def points(scene: Scene) -> tuple[Array, Array]:
        eye, direction = pixel_rays(scene)
        p = eye[:, None, None] - direction * (eye[1] / direction[1])
        assert np.abs(p[[0, 2]]).max() < 3, "the floor fills the picture"
        return p, -direction

    return points


OnFloor = Callable[[Scene], tuple[Array, Array]]


def picture(scene: Scene) -> Array:
    """(3, H, W) float64."""
    return np.moveaxis(render(scene).linear, 2, 0).astype(np.float64)


def test_a_point_light_obeys_lambert_and_the_inverse_square(
    floor: MakeScene, on_floor: OnFloor
) -> None:
    position, intensity = np.array([0.5, 1.5, -0.7]), np.array([3.0, 2.0, 1.0])
    scene = floor({"type": "point", "position": position.tolist(), "intensity": intensity.tolist()})
    p, _ = on_floor(scene)
    to_light = position[:, None, None] - p
    d = np.linalg.norm(to_light, axis=0)
    expected = (COLOR * intensity)[:, None, None] * (to_light[1] / d) / (np.pi * d**2)
    assert np.allclose(picture(scene), expected, rtol=1e-4)


def test_a_directional_light_obeys_lambert(floor: MakeScene) -> None:
    # Travels along (1, -2, -2): cos = 2 / 3; the length of the direction doesn't count.
    for length in (1.0, 1e-3, 1e12):
        direction = [length, -2 * length, -2 * length]
        scene = floor({"type": "directional", "direction": direction, "irradiance": [3, 2, 1]})
        expected = COLOR * [3, 2, 1] * 2 / 3 / np.pi
        assert np.allclose(picture(scene), expected[:, None, None], rtol=1e-6)


@pytest.mark.parametrize("exponent", [0.0, 1.0, 10.0, 300.0])
def test_the_highlight_is_blinn_phong(floor: MakeScene, on_floor: OnFloor, exponent: float) -> None:
    position, shine = np.array([-0.4, 1.9, -2.6]), np.array([0.3, 0.6, 1.0])
    light = {"type": "point", "position": position.tolist(), "intensity": 5}
    scene = floor(light, diffuse=0.5, specular=shine.tolist(), exponent=exponent)
    p, to_viewer = on_floor(scene)
    to_light = position[:, None, None] - p
    d = np.linalg.norm(to_light, axis=0)
    half = to_light / d + to_viewer
    cos_h = half[1] / np.linalg.norm(half, axis=0)
    irradiance = 5 * to_light[1] / d**3
    reflected = 0.5 * COLOR[:, None, None] + shine[:, None, None] * cos_h**exponent
    # The highlight is as steep as its exponent: float32 cosines err by 6e-8 times that, the offset by some 1e-6.
    assert np.allclose(picture(scene), reflected * irradiance / np.pi, rtol=1e-4 + 3e-6 * exponent)
    assert cos_h.max() > 0.999, "the highlight is in the picture"


def test_the_color_multiplies_ambient_and_diffuse_but_not_the_highlight(floor: MakeScene) -> None:
    sun = {"type": "directional", "direction": [0, -1, 0], "irradiance": np.pi}
    black = floor(sun, color=0, specular=1, exponent=0)
    assert np.allclose(picture(black), 1, rtol=1e-6)
    ambient = {"type": "ambient", "radiance": [1, 2, 4]}
    only_ambient = floor([ambient, ambient], ambient=0.25, diffuse=0)
    expected = 2 * 0.25 * COLOR * [1, 2, 4]
    assert np.allclose(picture(only_ambient), expected[:, None, None], rtol=1e-6)


def test_lights_add_up(floor: MakeScene) -> None:
    lights: list[dict[str, Any]] = [
        {"type": "ambient", "radiance": 0.2},
        {"type": "point", "position": [1, 1, 1], "intensity": [1, 2, 3]},
        {"type": "directional", "direction": [1, -1, 0], "irradiance": 0.5},
        {"type": "point", "position": [-1, 2, 1], "intensity": 4},
    ]
    each = [picture(floor(light, specular=0.4)) for light in lights]
    assert np.allclose(picture(floor(lights, specular=0.4)), sum(each), rtol=1e-6)


def test_light_from_behind_does_not_shine_through(floor: MakeScene) -> None:
    for light in (
        {"type": "point", "position": [0, -1, 0], "intensity": 9},
        {"type": "directional", "direction": [0, 1, 0], "irradiance": 9},
        {"type": "sphere", "center": [0, -1, 0], "radius": 0.5, "intensity": 9},
    ):
        assert not picture(floor(light, specular=1)).any()


def test_points_in_shadow_keep_exactly_their_ambient_term(make_scene: MakeScene) -> None:
    shade = {"shape": "quad", "material": "grey", "width": 2, "depth": 2}
    lights = [
        {"type": "ambient", "radiance": 0.25},
        {"type": "point", "position": [0, 3, 0], "intensity": 5},
    ]
    scene = make_scene(
        camera={"eye": [0, 0.5, 2.5], "look_at": [0, 0, 0]},
        sampler=ONE,
        objects=[FLOOR, shade | {"transform": [{"translate": [0, 1.5, 0]}]}],
        lights=lights,
        materials={"grey": {"color": COLOR.tolist(), "ambient": 0.5, "specular": 0.5}},
    )
    linear = render(scene).linear
    # The shade's shadow reaches to |x|, |z| = 2, over the lower half of the picture.
    ambient = (COLOR * 0.5).astype(np.float32) * np.float32(0.25)
    assert np.array_equal(linear[16:24, 10:22], np.broadcast_to(ambient, (8, 12, 3)))


@pytest.mark.parametrize(
    "light",
    [
        {"type": "rectangle", "corner": [-3, -3, 0], "edge_u": [6, 0, 0], "edge_v": [0, 6, 0]},
        {"type": "sphere", "center": [0, 0, 0], "radius": 3},
    ],
)
def test_the_camera_sees_a_light_by_its_radiance_and_not_one_by_intensity(
    make_scene: MakeScene, light: dict[str, Any]
) -> None:
    radiance = [0.1, 2.0, 30.0]
    shown = render(make_scene(lights=[light | {"radiance": radiance}])).linear
    assert np.array_equal(shown, np.broadcast_to(np.float32(radiance), shown.shape))
    assert not render(make_scene(lights=[light | {"intensity": radiance}])).linear.any()


def test_a_rectangle_light_is_dark_from_behind(make_scene: MakeScene) -> None:
    light = {"type": "rectangle", "corner": [-3, -3, 0], "edge_u": [0, 6, 0], "edge_v": [6, 0, 0]}
    environment = {"type": "constant", "radiance": 1}
    shown = render(make_scene(lights=[light | {"radiance": 5}], environment=environment)).linear
    assert not shown.any(), "it hides what is behind it, too"


def test_a_light_in_its_own_plane_or_at_a_surface_stays_finite(floor: MakeScene) -> None:
    for height in (0.0, 1e-30, 1e-9, 1e-7):
        scene = floor({"type": "point", "position": [0, height, 0], "intensity": 1}, specular=1)
        linear = render(scene).linear
        assert np.isfinite(linear).all()
        # Nearly in the plane, the light grazes everything but the point under it.
        assert np.median(linear) < 1e-5
