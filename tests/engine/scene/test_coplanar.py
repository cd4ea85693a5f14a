"""Lamps in the plane of a surface: lifted off it by so little that nobody sees it, or told."""

import math
import warnings
from typing import Any

import numpy as np
import pytest

from course import Scene, render
from course.base.errors import CourseWarning
from tests.conftest import MakeScene
from tests.lengths import fewer

RADIANCE, MIRROR, EXPONENT = 3.0, 0.8, 20
UP = {"rotate": {"axis": [0, 0, 1], "degrees": 180}}
CEILING = {"shape": "quad", "material": "black", "width": 4, "depth": 4} | {
    "transform": [UP, {"translate": [0, 1, 0]}]
}
# It shines down.
PANEL = {"type": "rectangle", "corner": [-1.4, 1, -0.5], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1]}
PANEL |= {"radiance": RADIANCE}


def room(make_scene: MakeScene, **parts: Any) -> Scene:
    """One point of a glossy floor, which mirrors the panel in the ceiling."""
    gloss = {"mirror": MIRROR, "gloss": {"lobe": "phong", "exponent": EXPONENT}}
    scene: dict[str, Any] = {
        "camera": {"eye": [1, 0.7, 0], "look_at": [0, 0, 0], "vertical_fov": 1e-4},
        "film": {"width": 16, "height": 16},
        "sampler": {"type": "sobol", "samples": 64},
        "materials": {"glossy": {"color": 0} | gloss, "black": {"color": 0}},
        "objects": [{"shape": "quad", "material": "glossy", "width": 4, "depth": 4}, CEILING],
        "lights": [PANEL],
        "integrator": {"max_depth": 1},
    }
    return make_scene(**scene | parts)


def expected() -> float:
    """The lobe's integral over the panel, by midpoints."""
    s, t = np.meshgrid(*[(np.arange(1000) + 0.5) / 1000] * 2)
    p = np.stack((s - 1.4, np.ones_like(s), t - 0.5))
    d = np.sqrt((p * p).sum(axis=0))
    axis = np.array([-1, 0.7, 0]) / math.hypot(1, 0.7)
    cosine = np.maximum(np.tensordot(axis, p, 1) / d, 0)
    density = (EXPONENT + 1) / (2 * math.pi) * cosine**EXPONENT
    return MIRROR * RADIANCE * float((density / d**3).mean())


@fewer
@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("way", ["lobe", "lamp", "balance", "power"])
@pytest.mark.usefixtures("each_form")
def test_a_panel_in_a_ceiling_loses_nothing(make_scene: MakeScene, way: str, kind: str) -> None:
    """Rays had met the ceiling: up to 60% was lost. Sobol's means are within 1%."""
    rules = {"type": kind, "max_depth": 1, "gloss_sampling": way}
    found = render(room(make_scene, integrator=rules)).linear
    assert found.mean(dtype=np.float64) == pytest.approx(expected(), rel=0.015)


def look_up(
    make_scene: MakeScene, degrees: float, lights: list[dict[str, Any]], **parts: Any
) -> Scene:
    """The ceiling and what is in it, turned about two axes, seen from below at a small angle."""
    turned = [
        UP,
        {"translate": [0, 1, 0]},
        {"rotate": {"axis": [1, 0, 0], "degrees": degrees}},
        {"rotate": {"axis": [0, 1, 0], "degrees": 2 * degrees}},
    ]
    a, b = math.radians(degrees), math.radians(2 * degrees)
    x = np.array([[1, 0, 0], [0, math.cos(a), -math.sin(a)], [0, math.sin(a), math.cos(a)]])
    y = np.array([[math.cos(b), 0, math.sin(b)], [0, 1, 0], [-math.sin(b), 0, math.cos(b)]])
    turn = y @ x
    placed = [
        light | {key: (turn @ light[key]).tolist() for key in ("corner", "edge_u", "edge_v")}
        for light in lights
    ]
    center = turn @ [-0.9, 1, 0]
    return room(
        make_scene,
        camera={
            "eye": (turn @ [1.2, 0.9, 0.3]).tolist(),
            "look_at": center.tolist(),
            "vertical_fov": 0.5,
        },
        sampler={"type": "random", "samples": 1},
        objects=[CEILING | {"transform": turned}],
        lights=placed,
        **parts,
    )


@pytest.mark.parametrize("degrees", [0, 17, 33])
@pytest.mark.usefixtures("each_form")
def test_the_camera_sees_all_of_it(make_scene: MakeScene, degrees: float) -> None:
    found = render(look_up(make_scene, degrees, [PANEL]), size=(64, 64)).linear
    np.testing.assert_allclose(found, RADIANCE, rtol=1e-6)


def test_a_panel_apart_is_left_where_it_is(make_scene: MakeScene) -> None:
    for corner, moved in (
        ([-1.4, 1, -0.5], True),
        ([-1.4, 1 - 1e-5, -0.5], False),
        ([2, 1, 0], False),
    ):
        matt = {"glossy": {"color": 1}, "black": {"color": 0}}
        scene = room(make_scene, lights=[PANEL | {"corner": corner}], materials=matt)
        (light,) = scene.compiled.world.lights
        right = scene.compiled.frame.position(np.array(corner))
        off = (light.corner - right) * [0, 1, 0]
        assert bool(abs(off).max() > 5e-7) == moved
        assert abs(off).max() < 2e-6


BULB = {"shape": "quad", "name": "bulb", "material": "glow", "width": 1, "depth": 1} | {
    "transform": [UP, {"translate": [0.3, 1, 0]}]
}


def test_objects_that_are_lamps_are_told(make_scene: MakeScene) -> None:
    """They shine to both sides, so that no side to lift them to is right."""
    parts: dict[str, Any] = {
        "materials": {"black": {"color": 0}, "glow": {"color": 0, "emission": RADIANCE}},
        "lights": [{"type": "object", "object": "bulb"}],
    }
    told = (
        r"scene.yaml:1: lights\[0\] lies in the plane of objects\[0\] and overlaps it: .*; move one"
    )
    with pytest.warns(CourseWarning, match=told):
        room(make_scene, objects=[CEILING, BULB], **parts)
    lower = BULB | {"transform": [UP, {"translate": [0.3, 0.999, 0]}]}
    beside = BULB | {"transform": [UP, {"translate": [2.5, 1, 0]}]}
    ball = {"shape": "sphere", "name": "bulb", "material": "glow", "segments": 96}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for bulb in (lower, beside, ball):
            room(make_scene, objects=[CEILING, bulb], **parts)


def test_two_panels_in_one_place_are_told_unless_back_to_back(make_scene: MakeScene) -> None:
    half = PANEL | {"corner": [-0.9, 1, -0.5]}
    with pytest.warns(CourseWarning, match=r"lights\[1\] lies in the plane of lights\[0\] and"):
        room(make_scene, lights=[PANEL, half])
    back = PANEL | {"edge_u": PANEL["edge_v"], "edge_v": PANEL["edge_u"], "radiance": 1.0}
    for lights in ([PANEL, back], [back, PANEL]):
        scene = look_up(make_scene, 20, lights)
        np.testing.assert_allclose(render(scene).linear, RADIANCE, rtol=1e-6)
