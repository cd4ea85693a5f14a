"""Shadow rays to the only lamp leave its mesh out, and see what they would see with it."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course.engine.core.motion import MovingAccelerator
from course.engine.loops import embree_device
from course.engine.render.render import render
from course.engine.scene.building import world
from course.engine.scene.scene import Scene
from course.engine.terms.lights.own_lamp import LampAccelerator

LAMP: dict[str, Any] = {"type": "sphere", "center": [0.6, 1.6, 0.3], "radius": 0.45, "radiance": 6}
MOTION: dict[str, Any] = {"motion": {"velocity": [0.6, 0, 0]}}
SPARED: dict[str, dict[str, Any]] = {
    "its surface": {"lights": [LAMP]},
    "the part that is seen": {"lights": [LAMP | {"samples": "visible"}]},
    "an object in it": {"lights": [LAMP], "ball": {"transform": [{"translate": [0.5, 1.2, 0.3]}]}},
    "something moves": {"lights": [LAMP], "ball": MOTION},
    "mirrors": {"lights": [LAMP], "material": {"mirror": 0.6}},
}
"""Scenes whose lamp is left out."""

KEPT: dict[str, dict[str, Any]] = {
    "two lamps, one in front of the other": {
        "lights": [LAMP, LAMP | {"center": [1.2, 3.2, 0.6], "radiance": 90}]
    },
    "a point behind it": {
        "lights": [LAMP, {"type": "point", "position": [1.2, 3.2, 0.6], "intensity": 30}]
    },
    "a lamp that moves": {"lights": [LAMP | MOTION]},
    "a sky that lights": {
        "lights": [LAMP],
        "environment": {"type": "constant", "radiance": 0.4, "lights": True},
    },
    "a lamp that isn't seen": {"lights": [LAMP | {"radiance": None, "intensity": 9}]},
}
"""Scenes whose lamps block light, or whose points may lie behind the mesh."""


def scene_of(make_scene: Callable[..., Scene], given: dict[str, Any]) -> Scene:
    lights = [
        {key: value for key, value in each.items() if value is not None} for each in given["lights"]
    ]
    return make_scene(
        camera={"eye": [0, 1.7, 4.2], "look_at": [0, 0.8, 0]},
        film={"width": 26, "height": 18},
        sampler={"samples": 16},
        environment=given.get("environment", {"type": "constant", "radiance": 0}),
        materials={"floor": {"color": [0.7, 0.6, 0.5]}, "ball": given.get("material", {})},
        lights=lights,
        objects=[
            {"shape": "quad", "material": "floor", "width": 9, "depth": 9},
            {"shape": "sphere", "material": "ball", "radius": 0.7}
            | {"transform": [{"translate": [0, 0.8, 0]}]}
            | given.get("ball", {}),
        ],
    )


def static_of(scene: Scene) -> Any:
    accelerator = scene.compiled.world.surface.accelerator
    return accelerator.static if isinstance(accelerator, MovingAccelerator) else accelerator


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize("name", SPARED)
def test_without_the_lamps_mesh_shadow_rays_see_the_same(
    name: str, compiled: bool, make_scene: Callable[..., Scene], monkeypatch: pytest.MonkeyPatch
) -> None:
    if compiled and not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    spared = scene_of(make_scene, SPARED[name])
    static = static_of(spared)
    assert isinstance(static, LampAccelerator)
    assert 0 < len(static.others.triangles) < len(static.triangles)
    found = render(spared, compiled=compiled)
    monkeypatch.setattr(
        world, "without_own_lamp", lambda surface, _lamp, _lights: surface.accelerator
    )
    whole = scene_of(make_scene, SPARED[name])
    assert not isinstance(static_of(whole), LampAccelerator)
    expected = render(whole, compiled=compiled)
    assert found.linear.std() > 0.05
    assert np.array_equal(found.linear, expected.linear)
    assert found.receipt.rays == expected.receipt.rays


@pytest.mark.parametrize("name", KEPT)
def test_lamps_that_may_block_light_are_kept(name: str, make_scene: Callable[..., Scene]) -> None:
    assert not isinstance(static_of(scene_of(make_scene, KEPT[name])), LampAccelerator)


def test_a_lamp_alone_has_nothing_to_be_left_out_of(make_scene: Callable[..., Scene]) -> None:
    scene = make_scene(
        lights=[LAMP],
        objects=[],
        materials={"grey": {}},
        camera={"eye": [0, 1, 4], "look_at": [0, 1, 0]},
    )
    assert not isinstance(static_of(scene), LampAccelerator)
