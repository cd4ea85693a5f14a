"""Surfaces that send out light by themselves: counted once wherever a ray meets them, lighting others by paths alone.

Where every path brings the same there is no noise, and the tolerance is that of float32 sums. Else pixels of the random
sampler are independent estimates of one number, whose mean is within 5.33 of its standard errors (false-fail rate 1e-7
for each of the 3 such numbers).
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import Picture, Scene, render
from course.errors import SceneError
from course.formats.pictures.files import save
from tests.conftest import MakeScene
from tests.effects import skies

pytestmark = pytest.mark.usefixtures("each_form")

INSIDE = {"eye": [0.1, 0.05, 0.2], "look_at": [1, 0.3, 0.2], "vertical_fov": 70}
BOX = {"shape": "box", "material": "m", "size": [2, 2, 2]}
BALL = {"shape": "sphere", "material": "m", "radius": 1, "segments": 24}
ONE = {"type": "random", "samples": 1}
PATHS = {"type": "path", "max_depth": 400, "roulette": None}
BOTH = [{"type": "distribution"}, {"type": "path"}]

UP = [{"rotate": {"axis": [1, 0, 0], "degrees": 180}}, {"translate": [0.7, 1, 0]}]
PANEL = {"shape": "quad", "material": "panel", "width": 1, "depth": 1, "transform": UP}
"""A square over a floor, its front down."""

POINT = np.array([0.6, 0, 0.1])
"""Where the camera looks, on the floor."""


def assert_mean(picture: Picture, expected: float) -> None:
    pixels = picture.linear[..., 0].ravel().astype(np.float64)
    error = pixels.std(ddof=1) / math.sqrt(len(pixels))
    assert abs(pixels.mean() - expected) <= 5.33 * error + 1e-4 * expected
    # A test that anything would pass is none.
    assert error < 0.02 * expected


def corners(mirrored: bool = False) -> np.ndarray:
    square = np.array([[0.2, 1, -0.5], [1.2, 1, -0.5], [1.2, 1, 0.5], [0.2, 1, 0.5]])
    return square * [-1, 1, 1] if mirrored else square


def share(square: np.ndarray) -> float:
    """Form factor of a square as the floor sees it."""
    return skies.form_factor(square - POINT, np.array([0.0, 1.0, 0.0]))


def over_a_floor(make_scene: MakeScene, **parts: Any) -> Scene:
    """A panel that glows by 3 over a floor that reflects a half."""
    description: dict[str, Any] = {
        "camera": {"eye": [2.5, 0.8, 0.1], "look_at": list(POINT), "vertical_fov": 0.01},
        "materials": {
            "floor": {"color": 0.5},
            "panel": {"color": 0, "emission": 3},
            "mirror": {"color": 0, "mirror": 0.8},
        },
        "objects": [{"shape": "quad", "material": "floor", "width": 60, "depth": 60}, PANEL],
        "sampler": {"type": "random", "samples": 64},
        "integrator": {"type": "path", "max_depth": 20},
    }
    return make_scene(**(description | parts))


# ---------------------------------------------------------------- furnaces


@pytest.mark.parametrize("shape", [BOX, BALL], ids=["box", "ball"])
@pytest.mark.parametrize("reflectance", [0.0, 0.1, 0.5, 0.8, 0.95])
def test_a_glowing_furnace_adds_up_every_reflection(
    make_scene: MakeScene, reflectance: float, shape: dict[str, Any]
) -> None:
    """1 + r + r^2 + ..., in each channel by its own emission; none of it twice."""
    emission = np.array([1, 2, 0.5])
    scene = make_scene(
        camera=INSIDE,
        materials={"m": {"color": reflectance, "emission": emission.tolist()}},
        objects=[shape],
        sampler=ONE,
        integrator=PATHS,
    )
    assert np.allclose(render(scene).linear, emission / (1 - reflectance), rtol=1e-5)


@pytest.mark.parametrize(
    "optics",
    [{"mirror": 0.3}, {"mirror": 0.3, "gloss": {"lobe": "phong", "exponent": 5}}],
    ids=["mirror", "gloss"],
)
def test_a_furnace_that_also_mirrors_adds_up_both_ways(
    make_scene: MakeScene, optics: dict[str, Any]
) -> None:
    material = {"color": 0.5, "emission": 1} | optics
    deep = PATHS | {"max_depth": 100}
    scene = make_scene(
        camera=INSIDE, materials={"m": material}, objects=[BOX], sampler=ONE, integrator=deep
    )
    assert np.allclose(render(scene).linear, 1 / (1 - 0.8), rtol=1e-4)


def test_mirrors_alone_are_a_furnace_of_the_distribution_ray_tracer(make_scene: MakeScene) -> None:
    scene = make_scene(
        camera=INSIDE,
        materials={"m": {"color": 0, "mirror": 0.5, "emission": 1}},
        objects=[BOX],
        sampler=ONE,
        integrator={"max_depth": 3, "cutoff": 0},
    )
    assert np.allclose(render(scene).linear, 1 + 0.5 + 0.25 + 0.125, rtol=1e-6)


# ---------------------------------------------------------------- seen, and seen in mirrors


@pytest.mark.parametrize("integrator", BOTH, ids=["distribution", "path"])
@pytest.mark.parametrize("eye", [[0.7, 0.2, 0], [0.7, 3, 0.001]], ids=["front", "back"])
def test_both_sides_glow(make_scene: MakeScene, integrator: Any, eye: list[float]) -> None:
    camera = {"eye": eye, "look_at": [0.7, 1, 0], "up": [0, 0, 1], "vertical_fov": 1}
    picture = render(over_a_floor(make_scene, camera=camera, integrator=integrator))
    assert (picture.linear == 3).all()


@pytest.mark.parametrize("integrator", BOTH, ids=["distribution", "path"])
def test_a_mirror_shows_it_by_its_reflectance(make_scene: MakeScene, integrator: Any) -> None:
    wall = {"shape": "quad", "material": "mirror", "width": 60, "depth": 60} | {
        "transform": [{"rotate": {"axis": [0, 0, 1], "degrees": -90}}]
    }
    # At the panel's image behind the mirror in the plane x = 0.
    camera = {"eye": [2.5, 0.3, 0.1], "look_at": [-0.7, 1, 0], "vertical_fov": 0.01}
    scene = over_a_floor(make_scene, camera=camera, objects=[PANEL, wall], integrator=integrator)
    assert np.allclose(render(scene).linear, 3 * 0.8, rtol=1e-6)


@pytest.mark.parametrize("integrator", BOTH, ids=["distribution", "path"])
def test_lights_by_radiance_go_on_shining_from_their_fronts_alone(
    make_scene: MakeScene, integrator: Any
) -> None:
    lamp = {"type": "rectangle", "corner": [-1, -1, 0], "edge_u": [2, 0, 0], "edge_v": [0, 2, 0]}
    glow = {"shape": "quad", "material": "panel", "transform": [{"translate": [0, 9, 0]}]}
    for eye, seen in (([0, 0, 4], 5), ([0, 0, -4], 0)):
        scene = make_scene(
            camera={"eye": eye, "look_at": [0, 0, 0], "vertical_fov": 5},
            materials={"panel": {"emission": 1}},
            objects=[glow],
            lights=[lamp | {"radiance": 5}],
            integrator=integrator,
        )
        assert (render(scene).linear == seen).all()


# ---------------------------------------------------------------- what it lights


def test_the_distribution_ray_tracer_lights_nothing_by_it(make_scene: MakeScene) -> None:
    picture = render(over_a_floor(make_scene, integrator={"type": "distribution"}))
    assert not picture.linear.any()
    assert picture.receipt.rays["shadow"] == 0


def test_paths_bring_its_light_by_its_form_factor(make_scene: MakeScene) -> None:
    scene = over_a_floor(make_scene)
    assert_mean(render(scene, size=(64, 64)), 0.5 * 3 * share(corners()))


def test_paths_bring_its_mirror_image_too(make_scene: MakeScene) -> None:
    wall = {"shape": "quad", "material": "mirror", "width": 60, "depth": 60} | {
        "transform": [{"rotate": {"axis": [0, 0, 1], "degrees": -90}}]
    }
    floor = {"shape": "quad", "material": "floor", "width": 60, "depth": 60}
    scene = over_a_floor(make_scene, objects=[floor, PANEL, wall])
    expected = 0.5 * 3 * (share(corners()) + 0.8 * share(corners(mirrored=True)))
    assert_mean(render(scene, size=(64, 64)), expected)


def test_a_light_beside_it_counts_once_as_ever(make_scene: MakeScene) -> None:
    """The panel by paths that run into it, the lamp by shadow rays; paths into the lamp add nothing."""
    other = corners(mirrored=True)
    lamp = {"type": "rectangle", "corner": other[0].tolist(), "radiance": 7} | {
        "edge_u": (other[3] - other[0]).tolist(),
        "edge_v": (other[1] - other[0]).tolist(),
    }
    # Its front down: cross(edge_u, edge_v).
    assert np.cross(lamp["edge_u"], lamp["edge_v"])[1] < 0
    scene = over_a_floor(make_scene, lights=[lamp])
    expected = 0.5 * (3 * share(corners()) + 7 * share(other))
    assert_mean(render(scene, size=(64, 64)), expected)


# ---------------------------------------------------------------- as a scene has it


def test_a_scene_that_only_glows_is_not_said_to_be_black(make_scene: MakeScene) -> None:
    from course.scene.lightless import why_black

    assert why_black(over_a_floor(make_scene)) == ""
    dark = over_a_floor(make_scene, materials={"floor": {}, "panel": {"emission": 0}})
    assert "black" in why_black(dark)


@pytest.mark.parametrize(
    ("emission", "told"),
    [
        (-1, "materials.m.emission is -1: expected a number >= 0"),
        ("[1, 2]", "materials.m.emission"),
        (1e30, "materials.m.emission: the emission is 1e+30"),
    ],
)
def test_an_emission_is_a_radiance(make_scene: MakeScene, emission: Any, told: str) -> None:
    with pytest.raises(SceneError) as caught:
        make_scene(materials={"m": {"emission": emission}}, objects=[BOX])
    assert told in str(caught.value)


@pytest.mark.parametrize("key", ["radiance", "emissive"])
def test_other_names_for_it_are_answered_with_its_own(make_scene: MakeScene, key: str) -> None:
    with pytest.raises(SceneError, match="did you mean emission"):
        make_scene(materials={"m": {key: 1}}, objects=[BOX])


@pytest.mark.parametrize("integrator", BOTH)
@pytest.mark.parametrize("lamp", [False, True], ids=["glows", "is a light"])
@pytest.mark.parametrize("ambient", [0.0, 2.0])
def test_a_texture_colours_what_is_reflected_and_not_what_is_sent_out(
    make_scene: MakeScene, tmp_path: Path, integrator: dict[str, Any], lamp: bool, ambient: float
) -> None:
    save(tmp_path / "quarter.exr", np.full((3, 2, 2), 0.25, np.float32))
    scene = make_scene(
        camera={"eye": [0, 2, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 5},
        film={"width": 4, "height": 4},
        sampler=ONE,
        materials={"m": {"color": 0.5, "emission": 3, "texture": {"image": "quarter.exr"}}},
        objects=[{"shape": "quad", "material": "m", "name": "panel"}],
        lights=[{"type": "ambient", "radiance": ambient}] * (ambient > 0)
        + [{"type": "object", "object": "panel"}] * lamp,
        integrator=integrator,
    )
    seen = render(scene).linear
    assert np.allclose(seen, 3 + 0.5 * 0.25 * ambient, rtol=1e-6)
