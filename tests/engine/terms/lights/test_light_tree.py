"""A light tree in the renderer: the mean is that of all lamps, with less noise; and what is called.

Means over independent pixels are compared as in tests/estimates.py: the difference is within the two bounds of 5
standard errors together with a false-fail rate below 1e-6. Some thirty are compared.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from course import Scene, render
from course.engine.core.lights.point import DirectionalLight, PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.types import Functions
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_variant
from course.engine.terms.lights.light_tree import TreeChoice, bounds_of
from tests.conftest import MakeScene
from tests.engine.terms.lights.test_light_choice import LIGHTS, POINTS, SUNS, WITH_A_SIZE, seen
from tests.estimates import estimate
from tests.lengths import fewer

each_form = pytest.mark.usefixtures("each_form")


def choice_of(scene: Scene) -> TreeChoice:
    choice: Any = scene.compiled.world
    assert isinstance(choice.choice, TreeChoice)
    return choice.choice


@fewer
@each_form
@pytest.mark.parametrize("name", LIGHTS)
@pytest.mark.parametrize("kind", ["distribution", "path"])
def test_the_mean_is_that_of_all_lights(make_scene: MakeScene, name: str, kind: str) -> None:
    known, bound = estimate(seen(make_scene, LIGHTS[name], "all", type=kind))
    mean, tolerance = estimate(seen(make_scene, LIGHTS[name], "tree", type=kind), 256)
    assert (np.abs(mean - known) < bound + tolerance + 1e-6 * known).all()
    assert (bound + tolerance < 0.2 * known).all()


@each_form
def test_a_uniform_choice_has_the_same_mean(make_scene: MakeScene) -> None:
    known, bound = estimate(seen(make_scene, LIGHTS["all kinds"], "all"))
    mean, tolerance = estimate(seen(make_scene, LIGHTS["all kinds"], "uniform"), 256)
    assert (np.abs(mean - known) < bound + tolerance + 1e-6 * known).all()


def test_suns_and_movers_stand_beside_the_tree(make_scene: MakeScene) -> None:
    still = choice_of(seen(make_scene, POINTS, "tree"))
    assert still.inside.tolist() == [0, 1, 2, 3]
    assert not len(still.outside)
    mixed = choice_of(seen(make_scene, LIGHTS["moving"] + WITH_A_SIZE, "tree"))
    moving = [k for k, light in enumerate(mixed.lights) if light.velocity is not None]
    suns = [k for k, light in enumerate(mixed.lights) if isinstance(light, DirectionalLight)]
    assert sorted(moving + suns) == mixed.outside.tolist()
    assert len(mixed.powers) == len(mixed.outside) + 1
    suns_alone = choice_of(seen(make_scene, SUNS, "tree"))
    assert suns_alone.tree is None
    assert suns_alone.outside.tolist() == [0, 1]


@pytest.mark.parametrize(
    ("lights", "called"),
    [
        (POINTS, {"light_tree", "tree_choice"}),
        (SUNS, {"power_choice"}),
        (POINTS + SUNS, {"light_tree", "power_choice", "tree_choice"}),
    ],
)
def test_it_says_which_functions_are_called(
    make_scene: MakeScene, lights: list[dict[str, Any]], called: set[str]
) -> None:
    effects = render(seen(make_scene, lights, "tree"), spp=1).receipt.effects
    found = {name for name in effects["called"] if name.startswith("many_lights.")}
    assert found == {f"many_lights.{name}" for name in called}


def test_where_no_tree_is_asked_for_the_module_is_not_imported(make_scene: MakeScene) -> None:
    scene = seen(make_scene, POINTS, "power")
    effects = render(scene, spp=1).receipt.effects
    assert "by a tree" in effects["skipped"]["many_lights"]
    assert "many_lights" not in scene.effects.imported


def test_bounds_hold_all_points_of_a_light() -> None:
    x, y, z = np.eye(3, dtype=np.float32)
    white = np.ones(3, np.float32)

    def bounds(light: Any) -> tuple[list[float], list[float], float]:
        found = bounds_of(light)
        assert found is not None
        return found[0].tolist(), found[1].tolist(), found[3]

    lamp = RectangleLight("", z, x - y, y, -y, white, Functions())
    assert bounds(lamp) == ([0, -1, 1], [1, 1, 1], 0)
    for other in (
        RectangleLight("", z, x - y, y, -y, white, Functions(), two_sided=True),
        RectangleLight("", z, x - y, y, None, white, Functions()),
    ):
        assert bounds(other)[2] == pytest.approx(np.pi)
    assert bounds(PointLight("", x, white)) == ([1, 0, 0], [1, 0, 0], pytest.approx(np.pi))


@pytest.mark.parametrize("suns", [0, 1])
def test_lights_whose_colours_are_lost_to_float32_are_black(
    make_scene: MakeScene, suns: int
) -> None:
    lamp = {"type": "point", "intensity": 1}
    sun = {"type": "directional", "direction": [0, -1, 0], "irradiance": 3}
    scene = make_scene(
        camera={"eye": [0, 3e30, 0], "look_at": [0, 0, 0], "up": [0, 0, 1]},
        objects=[{"shape": "quad", "material": "grey", "width": 8e30, "depth": 8e30}],
        integrator={"light_sampling": "tree"},
        lights=[lamp | {"position": [x, 1e30, 0]} for x in (-1e30, 1e30)] + [sun] * suns,
    )
    linear = render(scene, spp=16).linear
    assert np.isfinite(linear).all()
    assert (linear.mean() > 0) == bool(suns)


def test_a_thousand_candles_have_ten_times_less_noise() -> None:
    noise = {}
    for way in ("uniform", "tree"):
        path = PROJECT / "scenes" / "many_lights.yaml"
        keys: dict[tuple[str | int, ...], Any] = {
            ("integrator", "max_depth"): 0,
            ("integrator", "light_sampling"): way,
        }
        scene = load_variant(path, keys)
        one, two = (render(scene, size=(90, 60), seed=seed).linear for seed in (1, 2))
        noise[way] = np.sqrt(np.mean((one - two) ** 2))
    assert noise["uniform"] > 10 * noise["tree"]
