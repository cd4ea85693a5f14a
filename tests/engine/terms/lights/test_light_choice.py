"""One of many lights for each hit: the mean is that of all of them, at the price of one shadow ray.

Means over independent pixels are compared as in tests/estimates.py, of all lights and of chosen ones: the difference is
within the two bounds of 5 standard errors together with a false-fail rate below 1e-6. About 60 are compared.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from course import Scene, render
from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.formats.yaml.description import MANY_LIGHTS
from course.engine.terms.lights.light_choice import PowerChoice, power_of
from tests.conftest import MakeScene
from tests.estimates import estimate
from tests.lengths import fewer

each_form = pytest.mark.usefixtures("each_form")

POINTS = [
    {"type": "point", "position": [x, 1.5, z], "intensity": [i, 1.0, 3 - i]}
    for x, z, i in ((-1, 0.3, 0.1), (-0.4, -1, 1.0), (0.1, 0.1, 0.01), (0.9, -0.4, 2.9))
]
SUNS = [
    {"type": "directional", "direction": [x, -1, 0.2], "irradiance": e}
    for x, e in ((0.3, 1.0), (-0.8, [0.5, 0.1, 0.1]))
]
WITH_A_SIZE = [
    {"type": "sphere", "center": [-1, 1.3, -1], "radius": 0.3, "intensity": [2, 1, 1]},
    {"type": "sphere", "center": [1, 1.2, -1], "radius": 0.2, "radiance": [3, 6, 1]},
    {"type": "sphere", "center": [1, 0.9, 1], "radius": 0.2, "radiance": 3, "samples": "visible"},
    {
        "type": "rectangle",
        "corner": [-0.5, 1.4, -0.5],
        "edge_u": [1, 0, 0],
        "edge_v": [0, 0, 1],
        "radiance": [1, 2, 4],
    },
    {
        "type": "rectangle",
        "corner": [-1.5, 1.6, -0.5],
        "edge_u": [0.5, 0, 0],
        "edge_v": [0, 0, 0.5],
        "intensity": 1,
        "samples": "grid 2",
    },
    {"type": "object", "object": "lamp"},
]
MOVING = [
    {**POINTS[0], "motion": {"velocity": [0.5, 0, 0.2]}},
    {**WITH_A_SIZE[0], "motion": {"velocity": [0.5, 0, 0.2]}},
    {**WITH_A_SIZE[0], "intensity": 1.0},
    *SUNS,
]
LIGHTS = {
    "points": POINTS,
    "suns": SUNS,
    "with a size": WITH_A_SIZE,
    "moving": MOVING,
    "all kinds": POINTS + SUNS + WITH_A_SIZE,
}


def seen(make_scene: MakeScene, lights: list[dict[str, Any]], how: str, **integrator: Any) -> Scene:
    """One point of a floor with highlights, below a ball that hides some of the lights."""
    ball = {"shape": "sphere", "radius": 0.25, "segments": 16, "material": "grey"}
    return make_scene(
        camera={"eye": [0.05, 0.3, 0.3], "look_at": [0, 0, 0], "vertical_fov": 1e-3}
        | {"shutter": {"open": 0, "close": 1}},
        film={"width": 16, "height": 16},
        sampler={"type": "sobol", "samples": 64},
        integrator={"light_sampling": how, "max_depth": 1} | integrator,
        materials={
            "floor": {"color": [0.9, 0.7, 0.5], "specular": 0.3, "exponent": 20},
            "grey": {"color": 0.5},
            "glowing": {"color": 0, "emission": [5, 2, 1]},
        },
        objects=[
            {"shape": "quad", "material": "floor", "width": 6, "depth": 6},
            ball | {"transform": [{"translate": [-0.3, 0.6, 0.1]}]},
            ball
            | {"radius": 0.1, "name": "lamp", "material": "glowing"}
            | {"transform": [{"translate": [0.6, 0.8, 0.2]}]},
        ],
        lights=lights,
    )


@fewer
@each_form
@pytest.mark.parametrize("name", LIGHTS)
@pytest.mark.parametrize("kind", ["distribution", "path"])
def test_the_mean_is_that_of_all_lights(make_scene: MakeScene, name: str, kind: str) -> None:
    lights = LIGHTS[name]
    known, bound = estimate(seen(make_scene, lights, "all", type=kind))
    mean, tolerance = estimate(seen(make_scene, lights, "power", type=kind), 256)
    assert (np.abs(mean - known) < bound + tolerance + 1e-6 * known).all()
    # So small that what one light sends would be missed.
    assert (bound + tolerance < 0.2 * known).all()


@fewer
@each_form
@pytest.mark.parametrize("name", LIGHTS)
def test_a_hit_casts_one_shadow_ray(make_scene: MakeScene, name: str) -> None:
    scenes = [seen(make_scene, LIGHTS[name], how, max_depth=0) for how in ("all", "power")]
    everyone, one = (render(scene).receipt for scene in scenes)
    assert 0 < one.rays["shadow"] <= 16 * 16 * 64
    assert everyone.rays["shadow"] > (len(LIGHTS[name]) - 1) * one.rays["shadow"] / 2


def test_lights_of_a_kind_go_together_to_the_same_bits(make_scene: MakeScene) -> None:
    # One by one, as recordings ask them.
    scene = seen(make_scene, LIGHTS["all kinds"] + MOVING, "power")
    world: Any = scene.compiled.world
    assert world.choice.together
    together = render(scene, compiled=False).linear
    object.__setattr__(world, "choice", PowerChoice(world.lights, together=False))
    apart = render(scene, compiled=False).linear
    assert np.abs(apart - together).max() <= 1e-6 * together.max()


def test_equal_lights_are_one_kind(make_scene: MakeScene) -> None:
    lamps = [{"type": "point", "position": [0.01 * i, 1, 0], "intensity": i} for i in range(1, 100)]
    choice: Any = seen(make_scene, lamps, "power").compiled.world.choice
    assert len(choice._kinds[1]) == 1
    choice = seen(make_scene, [*lamps, *SUNS, *POINTS], "power").compiled.world.choice
    assert len(choice._kinds[1]) == 1 + len(SUNS) + len(POINTS)


def test_lights_are_chosen_in_proportion_to_their_power() -> None:
    color = np.array([1, 2, 3], np.float32)
    lights = tuple(PointLight(str(i), color * 0, color * np.float32(i)) for i in (1, 2, 5, 0.0001))
    choice = PowerChoice(lights)
    probability = choice.probabilities
    assert probability.sum() == pytest.approx(1, rel=1e-6)
    # A tenth goes to all alike, so that the faintest counts 40 times at most.
    expected = 0.9 * np.array([1, 2, 5, 0.0001]) / 8.0001 + 0.1 / 4
    assert np.allclose(probability, expected, rtol=1e-5)
    u = (np.arange(100_000, dtype=np.float32) + np.float32(0.5)) / np.float32(100_000)
    number, weight = choice.choose(None, u)  # type: ignore[arg-type]
    assert np.allclose(np.bincount(number) / len(u), probability, atol=2e-5)
    assert np.array_equal(weight, 1 / probability[number])
    ends = np.array([0, np.nextafter(np.float32(1), np.float32(0))], np.float32)
    assert choice.choose(None, ends)[0].tolist() == [0, 3]  # type: ignore[arg-type]


def test_power_is_that_of_the_textbook() -> None:
    white, up = np.ones(3, np.float32), np.array([0, 1, 0], np.float32)
    assert power_of(PointLight("", up, white)) == 4
    # A cell of an emitter shines to one side by its cosine: pi instead of 4 pi.
    assert power_of(PointLight("", up, white, normal=up)) == 1
    assert power_of(PointLight("", up, white, normal=up, two_sided=True)) == 2
    # The disk of the ball around the scene: pi R^2 of it, over pi^2.
    assert power_of(DirectionalLight("", up, white)) == 3


def test_few_lights_are_all_asked(make_scene: MakeScene) -> None:
    lamp = {"type": "point", "position": [0, 1, 0], "intensity": 1}
    grid = WITH_A_SIZE[4] | {"samples": "grid 9"}
    for lights, chosen in (
        ([lamp] * MANY_LIGHTS, False),
        ([lamp] * (MANY_LIGHTS + 1), True),
        # Eighty-one points, but one light of the file.
        ([grid], False),
        ([grid] * (MANY_LIGHTS + 1), True),
    ):
        world: Any = seen(make_scene, lights, "automatic").compiled.world
        assert (world.choice is not None) == chosen
    world = seen(make_scene, [lamp] * (MANY_LIGHTS + 1), "all").compiled.world
    assert world.choice is None
    # A choice of one is none.
    assert seen(make_scene, [lamp], "power").compiled.world.choice is None


@pytest.mark.parametrize("suns", [0, 1])
def test_lights_whose_colours_are_lost_to_float32_are_black(
    make_scene: MakeScene, suns: int
) -> None:
    lamp = {"type": "point", "intensity": 1}
    sun = {"type": "directional", "direction": [0, -1, 0], "irradiance": 3}
    lights = [lamp | {"position": [x, 1e30, 0]} for x in (-1e30, 1e30)] + [sun] * suns
    scene = make_scene(
        camera={"eye": [0, 3e30, 0], "look_at": [0, 0, 0], "up": [0, 0, 1]},
        objects=[{"shape": "quad", "material": "grey", "width": 8e30, "depth": 8e30}],
        integrator={"light_sampling": "power"},
        lights=lights,
    )
    linear = render(scene, spp=16).linear
    assert np.isfinite(linear).all()
    assert (linear.mean() > 0) == bool(suns)
