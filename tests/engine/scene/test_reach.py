"""What is farther away than float32 can carry is refused by its key."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course import Scene, render
from course.base.errors import SceneError

MakeScene = Callable[..., Scene]
BALL = {"shape": "sphere", "material": "grey"}


@pytest.mark.parametrize(
    "light",
    [
        {"type": "point", "position": [0, 1e60, 0], "intensity": 1},
        {"type": "sphere", "center": [0, 3, 0], "radius": 1e60, "intensity": 1},
        {
            "type": "rectangle",
            "corner": [0, 3, 0],
            "edge_u": [1e60, 0, 0],
            "edge_v": [0, 0, 1],
            "intensity": 1,
        },
    ],
)
def test_lights(make_scene: MakeScene, light: dict[str, Any]) -> None:
    with pytest.raises(
        SceneError, match=r"lights\[0\].*the light's (distance|size).*less than 1e\+18"
    ):
        make_scene(objects=[BALL], lights=[light])


def test_a_lamp_beside_large_and_small_objects(make_scene: MakeScene) -> None:
    """Small objects choose the frame together with the lamps, but not with one that nothing can hold."""
    lamp = {"type": "rectangle", "corner": [0, 3, 0], "edge_u": [2, -1e150, 0], "edge_v": [0, 0, 1]}
    with pytest.raises(SceneError, match=r"lights\[0\].*less than 1e\+18"):
        make_scene(objects=[BALL, {**BALL, "radius": 1e6}], lights=[{**lamp, "intensity": 1}])


def test_a_lamp_that_is_only_seen(make_scene: MakeScene) -> None:
    """No light falls on black things, but the lamp itself would be in the picture."""
    black = {"materials": {"black": {"color": 0}}, "objects": [{**BALL, "material": "black"}]}
    lamp = {"type": "rectangle", "corner": [0, 3, 0], "edge_u": [1, 0, 0], "radiance": 1}
    with pytest.raises(SceneError, match=r"lights\[0\].*far end.*less than 1e\+18"):
        make_scene(**black, lights=[{**lamp, "edge_v": [0, 0, 1e60]}])


@pytest.mark.parametrize("index", [1e-45, 1e-30, 1e-12, 1e60])
def test_glass_of_any_index(make_scene: MakeScene, index: float) -> None:
    glass = {"glass": {"dielectric": {"refraction_index": index}}}
    sky = {"type": "constant", "radiance": 1}
    picture = render(
        make_scene(materials=glass, objects=[{**BALL, "material": "glass"}], environment=sky)
    )
    # All of the light is reflected, as by a mirror.
    assert picture.linear == pytest.approx(1, rel=1e-3)


@pytest.mark.parametrize("radius", [1e8, 1e20, 1e38])
def test_noise_on_objects_of_any_size(make_scene: MakeScene, radius: float) -> None:
    """Where the places in the noise are beyond integers and float32, the picture is still finite."""
    materials = {"rough": {"bump": {"height": 0, "noise": {}}}}
    ball = {**BALL, "radius": radius, "material": "rough"}
    lights = [{"type": "ambient", "radiance": 1}]
    picture = render(make_scene(materials=materials, objects=[ball], lights=lights))
    assert np.isfinite(picture.linear).all()


def test_the_camera(make_scene: MakeScene) -> None:
    scene = make_scene(objects=[BALL], camera={"eye": [1e150, 0, 0], "look_at": [0, 0, 0]})
    with pytest.raises(SceneError, match=r"camera\.eye.*less than 1e\+18"):
        render(scene)


def test_short_exposures_of_fast_things_are_those_of_slow_ones(make_scene: MakeScene) -> None:
    """Only how far something goes counts: float32 can't carry 1e60 in a second."""

    def picture(seconds: float) -> bytes:
        ball = {**BALL, "motion": {"velocity": [0.5 / seconds, 0, 0]}}
        camera = {"eye": [0, 0, 4], "look_at": [0, 0, 0], "shutter": {"open": 0, "close": seconds}}
        light = {"type": "directional", "direction": [0, -1, -1], "irradiance": 3}
        return render(make_scene(objects=[ball], lights=[light], camera=camera)).linear.tobytes()

    assert picture(2.0**-200) == picture(1.0)
