"""Pictures that are likely to be black: named with their reason, black indeed, and nothing else is."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from course import Scene, load_scene, render
from course.base.errors import CourseWarning
from course.engine.casters.choice import chosen
from course.engine.core.accelerator import StaticAccelerator
from course.engine.functions.effects import PROJECT
from course.engine.scene.darkness import warn_of_darkness, why_dark
from tests.forms import FORMS, needs_numba

MakeScene = Callable[..., Scene]

FLOOR = {"shape": "quad", "material": "grey", "width": 8, "depth": 8}
BELOW = FLOOR | {"transform": [{"translate": [0, -2, 0]}]}
GROUND = FLOOR | {"width": 80, "depth": 80, "transform": [{"translate": [0, -6, 0]}]}
ABOVE = FLOOR | {"transform": [{"translate": [0, 6, 0]}]}
BOX = {"shape": "box", "name": "wall", "material": "grey", "size": [2, 2, 2]}
BALL = {"shape": "sphere", "material": "grey"}
HIGH = BALL | {"transform": [{"translate": [0, 9, 0]}]}
POINT = {"type": "point", "position": [0, 5, 0], "intensity": 10}
SUN = {"type": "directional", "direction": [0.1, -1, 0.2], "irradiance": 1}
SPOT = {"type": "spot", "position": [0, 5, 0], "direction": [0, -1, 0], "intensity": 10}
SPOT |= {"inner_angle": 2, "outer_angle": 4}
LAMP = {"type": "rectangle", "corner": [-1, 3, -1], "radiance": 5, "visible": False}
DOWN = LAMP | {"edge_u": [2, 0, 0], "edge_v": [0, 0, 2]}
UP = LAMP | {"edge_u": [0, 0, 2], "edge_v": [2, 0, 0]}
OPEN = {"aperture_radius": 1, "focus_distance": 3}
SKY = {"type": "constant", "radiance": 1}
DOWN_AT = {"eye": [0, 2, 0.5], "look_at": [0, 0, 0]}
OUTSIDE = {"eye": [0, 1, 4], "look_at": [0, 0, 0]}
INSIDE = {"eye": [0, 0, 0.5], "look_at": [0.2, 0, 0]}


def _wall(
    degrees: float, axis: list[float], place: list[float], width: float = 20.0
) -> dict[str, Any]:
    """A sheet at that place around the camera, which sees its back."""
    turn = {"rotate": {"axis": axis, "degrees": degrees}}
    return FLOOR | {"width": width, "depth": 20, "transform": [turn, {"translate": place}]}


# All around are backs, and the picture shows the slit between two of them.
WINDOW = [
    _wall(0, [1, 0, 0], [0, 4, 0]),
    _wall(180, [1, 0, 0], [0, -4, 0]),
    _wall(-90, [1, 0, 0], [0, 0, -4]),
    _wall(-90, [0, 0, 1], [4, 0, 0]),
    _wall(90, [0, 0, 1], [-4, 0, 0]),
    _wall(90, [1, 0, 0], [10.1, 0, 3]),
    _wall(90, [1, 0, 0], [-10.1, 0, 3]),
]
THROUGH = {"eye": [0.3, 0, 0], "look_at": [0.03, 0, 3], "vertical_fov": 0.5}
AWAY = {"eye": [0, 1, 9], "look_at": [0, 1, 12]}
BESIDE = {"eye": [0, 1, 9], "look_at": [9, 1, 5]}
UNDER = {"eye": [0, -3, 0.5], "look_at": [0, 0, 0]}


@pytest.mark.parametrize("packets", FORMS)
@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize(
    ("parts", "reason"),
    [
        ({"objects": [FLOOR]}, "the scene has no lights"),
        ({"objects": [FLOOR], "lights": [UP]}, "in front of a light"),
        ({"objects": [FLOOR, BALL], "lights": [UP, UP]}, "(light 0, light 1)"),
        ({"objects": [BELOW, BOX], "lights": [POINT], "camera": INSIDE}, "inside wall (objects.1)"),
        ({"objects": [BELOW, BOX], "lights": [SUN], "camera": INSIDE}, "stands inside wall ("),
        ({"objects": [BALL], "environment": SKY, "camera": INSIDE}, "stands inside sphere ("),
        ({"objects": [HIGH], "lights": [POINT]}, "no object is in front of the camera"),
        ({"objects": [FLOOR], "lights": [POINT], "camera": AWAY}, "no object is in front of"),
        ({"objects": [FLOOR, BALL], "lights": [POINT], "camera": BESIDE}, "no object is in front"),
    ],
)
def test_a_black_picture_is_told_with_its_reason(
    make_scene: MakeScene, parts: dict[str, Any], reason: str, kind: str, packets: bool
) -> None:
    scene = make_scene(**{"camera": OUTSIDE, "integrator": {"type": kind}} | parts)
    with pytest.warns(CourseWarning, match="black") as told:
        warn_of_darkness(scene, Path("my.yaml"), packets)
    (warning,) = told
    message = str(warning.message)
    assert message.startswith("my.yaml: the picture ")
    assert reason in message
    assert "\n" not in message


@pytest.mark.parametrize("light", [POINT, SUN, POINT | {"type": "sphere"}])
def test_what_is_seen_from_its_dark_side(make_scene: MakeScene, light: dict[str, Any]) -> None:
    if light["type"] == "sphere":
        light = {"type": "sphere", "center": [0, 5, 0], "radius": 0.5, "intensity": 9}
    parts = {"objects": [FLOOR], "camera": UNDER, "lights": [light]}
    assert "turned away from the lights" in why_dark(make_scene(**parts))
    # Light that comes by way of another surface is a path tracer's.
    path = parts | {"integrator": {"type": "path"}}
    assert "turned away from the lights" in why_dark(make_scene(**path))
    assert why_dark(make_scene(**path | {"objects": [FLOOR, GROUND]})) == ""
    assert why_dark(make_scene(**parts | {"camera": OUTSIDE})) == ""


def test_a_spot_light_that_shines_elsewhere_is_told(make_scene: MakeScene) -> None:
    away = SPOT | {"direction": [0, 1, 0.2]}
    parts = {"objects": [FLOOR], "lights": [away], "camera": OUTSIDE}
    scene = make_scene(**parts)
    assert why_dark(scene).endswith("(light 0): turn the direction of spots")
    assert not render(scene, spp=4).linear.any()
    path = parts | {"integrator": {"type": "path"}}
    assert why_dark(make_scene(**path)) == why_dark(scene)
    assert why_dark(make_scene(**path | {"objects": [FLOOR, ABOVE]})) == ""
    told = why_dark(make_scene(**parts | {"lights": [away, UP]}))
    assert told.endswith(
        "turn the direction of spots, or exchange edge_u and edge_v, or set two_sided"
    )


@pytest.mark.parametrize(
    "parts",
    [
        {"objects": [FLOOR], "lights": [DOWN]},
        {"objects": [FLOOR], "lights": [UP, DOWN]},
        {"objects": [FLOOR], "lights": [SPOT]},
        {"objects": [FLOOR], "lights": [SPOT | {"direction": [2, -1, 0]}, POINT]},
        {"objects": [FLOOR], "lights": [UP | {"two_sided": True}]},
        {"objects": [FLOOR], "lights": [UP], "environment": SKY},
        {"objects": [FLOOR], "lights": [POINT], "environment": SKY, "camera": AWAY},
        {"objects": [FLOOR], "lights": [DOWN | {"visible": True}], "camera": AWAY},
        {"objects": [BALL | {"radius": 1e-4}], "lights": [POINT]},
        {"objects": WINDOW, "lights": [POINT], "environment": SKY, "camera": THROUGH},
        {"objects": [FLOOR], "lights": [POINT], "camera": AWAY | {"lens": OPEN}},
        {"objects": [FLOOR], "lights": [UP, {"type": "ambient", "radiance": 1}]},
        {"objects": [FLOOR], "lights": [UP], "materials": {"grey": {"mirror": 0.5}}},
        {"objects": [FLOOR], "lights": [UP], "materials": {"grey": {"emission": 0.5}}},
        {"objects": [FLOOR], "lights": [UP], "materials": {"grey": {"unlit": 0.5}}},
        {"objects": [BALL], "materials": {"grey": {"unlit": 1}}}
        | {"lights": [{"type": "ambient", "radiance": 1}]},
        {"objects": [BOX], "materials": {"grey": {"unlit": 1}}, "camera": INSIDE},
        {"objects": [FLOOR, HIGH | {"material": "glow"}], "integrator": {"type": "path"}}
        | {"materials": {"grey": {}, "glow": {"unlit": 3}}},
        {"objects": [FLOOR, ABOVE], "lights": [UP], "integrator": {"type": "path"}},
        {"objects": [BOX], "lights": [POINT | {"position": [0.5, 0.5, 0]}], "camera": INSIDE},
        {"objects": [BELOW, BOX], "lights": [POINT | {"position": [0, 0, 0]}, POINT]},
        {"objects": [FLOOR, HIGH | {"material": "glow"}], "integrator": {"type": "path"}}
        | {"materials": {"grey": {}, "glow": {"emission": 3}}},
        {"objects": [FLOOR], "environment": SKY, "integrator": {"type": "path"}},
        {"objects": [FLOOR], "environment": SKY | {"lights": True}},
        {"objects": [BOX], "lights": [POINT, {"type": "ambient", "radiance": 1}], "camera": INSIDE},
        {"objects": [BOX], "environment": SKY, "camera": INSIDE}
        | {"materials": {"grey": {"dielectric": {}}}},
        {
            "objects": [FLOOR | {"motion": {"velocity": [1, 0, 0]}}],
            "lights": [UP],
            "camera": OUTSIDE | {"shutter": {"open": 0, "close": 1}},
        },
    ],
)
def test_where_light_may_be_seen_nothing_is_said(
    make_scene: MakeScene, parts: dict[str, Any]
) -> None:
    assert why_dark(make_scene(**{"camera": OUTSIDE} | parts)) == ""


GLOW = {"grey": {}, "glow": {"emission": 3}}
IN_BALL = BALL | {"radius": 0.9}
CUT = [BALL | {"name": "shell", "radius": 2}, FLOOR]
LAMPS = [
    POINT | {"position": [0.2, 0.1, 0]},
    SPOT | {"position": [0, 0, 0]},
    {"type": "sphere", "center": [0.2, 0, 0], "radius": 0.3, "radiance": 3},
    LAMP | {"corner": [-0.2, 0, -0.2], "edge_u": [0.4, 0, 0], "edge_v": [0, 0, 0.4]},
]


@pytest.mark.parametrize(
    ("parts", "kinds", "reason"),
    [
        *(
            (
                {"objects": [BELOW, IN_BALL], "lights": [lamp]},
                "both",
                "0 is inside sphere (objects.1)",
            )
            for lamp in LAMPS
        ),
        (
            {"objects": [BELOW, BOX], "lights": LAMPS[:2]},
            "both",
            "light 0 is inside wall (objects.1)",
        ),
        (
            {"objects": [BELOW, IN_BALL], "lights": LAMPS[:1], "environment": SKY}
            | {"camera": {"eye": [0, -1.5, 0.5], "look_at": [0, -2, 0]}},
            "distribution",
            "is inside sphere",
        ),
        (
            {
                "objects": CUT,
                "lights": [POINT],
                "camera": {"eye": [0, 1, 0], "look_at": [1, 0.6, 0]},
            },
            "both",
            "stands inside shell (objects.0)",
        ),
        (
            {
                "objects": CUT,
                "environment": SKY,
                "camera": {"eye": [0, 1, 0], "look_at": [1, 0, 0]},
            },
            "both",
            "stands inside shell (objects.0)",
        ),
        (
            {"objects": [FLOOR, HIGH | {"material": "glow"}], "materials": GLOW},
            "distribution",
            "add {type: object",
        ),
        (
            {"objects": [FLOOR, ABOVE | {"material": "glow"}], "materials": GLOW}
            | {"camera": UNDER | {"look_at": [0, -1, 0]}},
            "both",
            "what emits light",
        ),
        (
            {"objects": [FLOOR], "environment": SKY},
            "distribution",
            "set environment.lights",
        ),
        (
            {"objects": [FLOOR, _wall(0, [1, 0, 0], [0, 3, 0])], "lights": [POINT]},
            "both",
            "something stands before light 0",
        ),
    ],
)
def test_light_that_is_hidden_from_all_that_is_seen(
    make_scene: MakeScene, parts: dict[str, Any], kinds: str, reason: str
) -> None:
    for kind in ("distribution", "path") if kinds == "both" else (kinds,):
        scene = make_scene(**{"camera": DOWN_AT} | parts, integrator={"type": kind})
        assert reason in why_dark(scene)
        assert not render(scene, spp=4).linear.any()


@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize(
    "parts",
    [
        {"objects": [FLOOR], "lights": [UP], "camera": OUTSIDE},
        {"objects": [BELOW, BOX], "lights": [POINT], "camera": INSIDE},
        {"objects": [FLOOR, BALL], "lights": [POINT], "camera": BESIDE},
    ],
)
def test_what_is_told_to_be_black_is(
    make_scene: MakeScene, parts: dict[str, Any], kind: str
) -> None:
    scene = make_scene(**parts, integrator={"type": kind})
    assert why_dark(scene)
    assert not render(scene, spp=4).linear.any()


@pytest.mark.parametrize("name", ["cornell_box", "path_tracing", "hall_of_mirrors", "radiosity"])
def test_a_room_with_a_lamp_is_bright(name: str) -> None:
    assert why_dark(load_scene(PROJECT / "scenes" / f"{name}.yaml")) == ""


@needs_numba
@pytest.mark.parametrize("objects", [[], [FLOOR]])
def test_for_compiled_loops_no_other_hierarchy_is_built(
    make_scene: MakeScene, objects: list[dict[str, Any]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(StaticAccelerator, "caster", property(lambda _: 1 / 0))
    if chosen() == "embree":
        assert why_dark(make_scene(camera=OUTSIDE, objects=objects, lights=[UP]), packets=True)


def test_no_function_of_a_student_is_called(make_scene: MakeScene) -> None:
    scene = make_scene(camera=OUTSIDE, objects=[FLOOR], lights=[UP])
    before = set(scene.effects.imported)
    assert why_dark(scene)
    assert set(scene.effects.imported) == before


class Other:
    """A light of a type that nothing here knows."""

    name, width, color = "light 0", 0, (1.0, 1.0, 1.0)


def test_of_a_light_of_another_type_nothing_is_told(make_scene: MakeScene) -> None:
    scene = make_scene(objects=[BOX], lights=[POINT], camera=INSIDE)
    assert "stands inside wall" in why_dark(scene)
    world: Any = replace(scene.compiled.world, lights=(Other(),))  # type: ignore[arg-type]
    assert why_dark(replace(scene, compiled=replace(scene.compiled, world=world))) == ""
