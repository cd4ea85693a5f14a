"""Surfaces that send out light by themselves: counted once wherever a ray meets them, lighting others by paths alone.

What it brings to others beside lights is in test_object_lights.py, the furnace in test_path_tracing.py.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import render
from course.base.errors import SceneError
from course.engine.formats.pictures.files import save
from tests.conftest import MakeScene
from tests.engine.terms.lights.over_a_floor import DISTRIBUTION, PATHS, both, over_a_floor, panel

pytestmark = pytest.mark.usefixtures("each_form")

INSIDE = {"eye": [0.1, 0.05, 0.2], "look_at": [1, 0.3, 0.2], "vertical_fov": 70}
BOX = {"shape": "box", "material": "m", "size": [2, 2, 2]}
ONE = {"type": "random", "samples": 1}
# ---------------------------------------------------------------- furnaces


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


@both
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
    picture = render(over_a_floor(make_scene, [panel()], [], DISTRIBUTION))
    assert not picture.linear.any()
    assert picture.receipt.rays["shadow"] == 0


# ---------------------------------------------------------------- as a scene has it


def test_a_scene_that_only_glows_is_not_said_to_be_black(make_scene: MakeScene) -> None:
    from course.engine.scene.darkness import why_black

    assert why_black(over_a_floor(make_scene, [panel()], [], PATHS)) == ""
    black = {"floor": {}, "panel": {"emission": 0}}
    dark = over_a_floor(make_scene, [panel()], [], PATHS, materials=black)
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


@both
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
