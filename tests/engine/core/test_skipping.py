"""A scene pays for the effects it has: no number, no ray and no import for any other, and the receipt says why."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import render
from tests.conftest import MakeScene
from tests.processes import python

PATHS = 32 * 32 * 4
CAMERA = {"eye": [0, 0, 4], "look_at": [0, 0, 0]}
WALL = {"shape": "quad", "material": "grey", "width": 100, "depth": 100} | {
    "transform": [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}]
}
POINT = {"type": "point", "position": [0, 1, 5], "intensity": 3}
BALL = {"type": "sphere", "center": [0, 1, 5], "radius": 0.5, "intensity": 3}
PANEL = {"type": "rectangle", "corner": [-1, 0, 5], "edge_u": [0, 2, 0], "edge_v": [2, 0, 0]}
LENS = {"aperture_radius": 0.1, "focus_distance": 4}
MOVES = {"motion": {"velocity": [1, 0, 0]}}
GLOSS = {"lobe": "plane", "roughness": 0.2}
REASONS = {
    "soft_shadows": "no light takes its points on a rectangle or in a ball",
    "glossy": "no mirror is glossy by its functions",
    "thin_lens": "the aperture is 0",
    "motion_blur": "nothing moves",
}


def description(**parts: Any) -> dict[str, Any]:
    """What parts change of a wall that a point light lights."""
    plain: dict[str, Any] = {
        "camera": CAMERA,
        "film": {"width": 32, "height": 32},
        "sampler": {"type": "sobol", "samples": 4},
        "materials": {"grey": {}},
        "objects": [WALL],
        "lights": [POINT],
    }
    return plain | parts


NOTHING: list[tuple[str, dict[str, Any]]] = [
    ("plain", {}),
    ("no aperture", {"camera": CAMERA | {"lens": LENS | {"aperture_radius": 0}}}),
    ("perfect mirror", {"materials": {"grey": {"mirror": 0.5}}}),
    ("no roughness", {"materials": {"grey": {"mirror": 0.5, "gloss": GLOSS | {"roughness": 0}}}}),
    ("no mirror", {"materials": {"grey": {"gloss": GLOSS}}}),
    ("a mirror of 0", {"materials": {"grey": {"mirror": [0, 0, 0], "gloss": GLOSS}}}),
    ("gloss on nothing", {"materials": {"grey": {}, "other": {"mirror": 1, "gloss": GLOSS}}}),
    (
        "no bounces",
        {"materials": {"grey": {"mirror": 1, "gloss": GLOSS}}, "integrator": {"max_depth": 0}},
    ),
    ("no velocity", {"objects": [WALL | {"motion": {"velocity": [0, 0, 0]}}]}),
    (
        "closed shutter",
        {"objects": [WALL | MOVES], "camera": CAMERA | {"shutter": {"open": 3, "close": 3}}},
    ),
    ("no radius", {"lights": [BALL | {"radius": 0}]}),
    ("no power", {"lights": [BALL | {"intensity": 0}, PANEL | {"intensity": [0, 0, 0]}]}),
    ("grid without power", {"lights": [PANEL | {"intensity": 0, "samples": "grid 9"}]}),
    ("ambient light alone", {"lights": [{"type": "ambient", "radiance": 1}]}),
]


@pytest.mark.parametrize("parts", [p for _, p in NOTHING], ids=[n for n, _ in NOTHING])
def test_without_an_effect_no_number_and_no_module(
    make_scene: MakeScene, parts: dict[str, Any]
) -> None:
    scene = make_scene(**description(**parts))
    receipt = render(scene).receipt
    assert receipt.numbers == {"pixel": 2 * PATHS}
    assert scene.effects.imported == ("supersampling",)
    assert receipt.effects["called"] == ["supersampling.resolve"]
    for module, reason in REASONS.items():
        assert reason in receipt.effects["skipped"][module]
    assert scene.compiled.world.lens is None
    assert scene.compiled.world.motion is None
    assert scene.compiled.world.lobes == ()


# What one effect costs: the numbers it draws, the rays it adds, the functions it calls.
EFFECTS: dict[str, tuple[dict[str, Any], dict[str, int], dict[str, int], set[str]]] = {
    "lens": (
        {"camera": CAMERA | {"lens": LENS}},
        {"lens": 2},
        {"shadow": 1},
        {"thin_lens.point_on_disk", "thin_lens.lens_rays"},
    ),
    "square lens": (
        {"camera": CAMERA | {"lens": LENS | {"shape": "square"}}},
        {"lens": 2},
        {"shadow": 1},
        {"thin_lens.lens_rays"},
    ),
    "moving object": (
        {"objects": [WALL | MOVES]},
        {"time": 1},
        {"shadow": 1},
        {f"motion_blur.{f}" for f in ("shutter_times", "displacement", "to_object_space")},
    ),
    "moving camera": (
        {"camera": CAMERA | MOVES},
        {"time": 1},
        {"shadow": 1},
        {"motion_blur.shutter_times", "motion_blur.displacement"},
    ),
    "moving light": (
        {"lights": [POINT | MOVES]},
        {"time": 1},
        {"shadow": 1},
        {"motion_blur.shutter_times", "motion_blur.displacement"},
    ),
    "plane lobe": (
        {"materials": {"grey": {"mirror": 0.5, "gloss": GLOSS}}},
        {"gloss": 2},
        {"shadow": 1, "reflection": 1},
        {"glossy.jitter_on_plane", "glossy.keep_above"},
    ),
    "ball lobe": (
        {"materials": {"grey": {"mirror": 0.5, "gloss": {"lobe": "ball", "glossiness": 0.1}}}},
        {"gloss": 3},
        {"shadow": 1, "reflection": 1},
        {"glossy.jitter_in_ball", "glossy.keep_above"},
    ),
    "phong lobe": (
        {"materials": {"grey": {"mirror": 0.5, "gloss": {"lobe": "phong", "exponent": 9}}}},
        {"gloss": 2},
        {"shadow": 1, "reflection": 1},
        {"glossy.sample_phong_lobe", "glossy.keep_above"},
    ),
    "sphere": ({"lights": [BALL]}, {"light 0": 2}, {"shadow": 1}, {"soft_shadows.point_on_sphere"}),
    "ball": (
        {"lights": [BALL | {"samples": "ball"}]},
        {"light 0": 3},
        {"shadow": 1},
        {"soft_shadows.point_in_ball"},
    ),
    "facing disk": (
        {"lights": [BALL | {"samples": "facing disk"}]},
        {"light 0": 2},
        {"shadow": 1},
        {"soft_shadows.point_on_facing_disk"},
    ),
    "rectangle": (
        {"lights": [PANEL | {"intensity": 1}]},
        {"light 0": 2},
        {"shadow": 1},
        {"soft_shadows.point_on_rectangle"},
    ),
    "grid": (
        {"lights": [PANEL | {"intensity": 1, "samples": "grid 3"}]},
        {},
        {"shadow": 9},
        {"soft_shadows.light_grid"},
    ),
}


@pytest.mark.parametrize("effect", EFFECTS)
def test_an_effect_costs_its_own_numbers_rays_and_module_and_no_other(
    make_scene: MakeScene, effect: str
) -> None:
    parts, numbers, rays, functions = EFFECTS[effect]
    scene = make_scene(**description(**parts))
    receipt = render(scene).receipt
    expected = {"pixel": 2} | numbers
    assert receipt.numbers == {name: count * PATHS for name, count in expected.items()}
    per_path = {"camera": 1, "shadow": 0, "reflection": 0, "refraction": 0} | rays
    assert receipt.rays == {kind: count * PATHS for kind, count in per_path.items()}
    assert set(receipt.effects["called"]) == functions | {"supersampling.resolve"}
    modules = {function.partition(".")[0] for function in functions}
    assert set(scene.effects.imported) == modules | {"supersampling"}
    assert set(receipt.effects["skipped"]) >= set(REASONS) - modules
    assert not set(receipt.effects["skipped"]) & modules


RENDERED = """
import json, sys
from pathlib import Path
from course import load_scene, render
for name in sys.argv[1:]:
    there = set(sys.modules)
    render(load_scene(name))
    new = [n for n in sys.modules if n.startswith(("course_effects", "numpy.random"))]
    print(json.dumps(new))
    # The next scene finds none of them.
    for n in set(sys.modules) - there:
        if n.startswith("course_effects"):
            del sys.modules[n]
"""
"""Renders scenes, and prints what each has imported."""


def test_a_process_imports_the_modules_of_its_scene_only(tmp_path: Path) -> None:
    one = {"sampler": {"type": "sobol", "samples": 1}, "film": {"width": 4, "height": 4}}
    scenes = {"plain": ({}, set[str]())} | {
        name: (parts, functions) for name, (parts, _, _, functions) in EFFECTS.items()
    }
    for name, (parts, _) in scenes.items():
        (tmp_path / name).write_text(json.dumps(description(**parts) | one), encoding="utf-8")
    done = python("-c", RENDERED, *scenes, folder=tmp_path, environment={"PATH": ""})
    for (name, (_, functions)), line in zip(scenes.items(), done.stdout.splitlines(), strict=True):
        found = {each.rpartition(".")[2] for each in json.loads(line)}
        assert found == {function.partition(".")[0] for function in functions}, name


AWAY = [
    ("no power", POINT | {"intensity": 0}),
    ("point behind", POINT | {"position": [0, 1, -5]}),
    ("sun behind", {"type": "directional", "direction": [0, 0, 1], "irradiance": 1}),
    ("sphere behind", BALL | {"center": [0, 1, -5]}),
    ("behind", PANEL | {"corner": [-1, 0, -5], "intensity": 1}),
    ("grid behind", PANEL | {"corner": [-1, 0, -5], "intensity": 1, "samples": "grid 4"}),
    ("looks away", PANEL | {"edge_u": [2, 0, 0], "edge_v": [0, 2, 0], "radiance": 1}),
    (
        "grid looks away",
        PANEL | {"edge_u": [2, 0, 0], "edge_v": [0, 2, 0], "radiance": 1, "samples": "grid 4"},
    ),
    ("ball behind", BALL | {"center": [0, 0, -5], "samples": "ball"}),
    ("disk behind", BALL | {"center": [0, 0, -5], "samples": "facing disk"}),
    ("emitter behind", BALL | {"center": [0, 0, -5], "intensity": None, "radiance": 1}),
    ("moves behind", POINT | {"position": [0, 0, -5], "motion": {"velocity": [1, 0, 0]}}),
]


@pytest.mark.parametrize("light", [light for _, light in AWAY], ids=[name for name, _ in AWAY])
def test_a_light_that_no_hit_faces_casts_no_ray(
    make_scene: MakeScene, light: dict[str, Any]
) -> None:
    picture = render(make_scene(**description(lights=[light])))
    assert picture.receipt.rays["shadow"] == 0
    assert not picture.linear.any()


def test_half_of_a_ball_behind_the_wall_costs_half_of_the_rays(make_scene: MakeScene) -> None:
    # One random point of it for each sample: those behind the wall cast no ray. Binomial, 6 deviations are 2e-9.
    light = BALL | {"center": [0, 0, 0], "radius": 1.5}
    rays = render(make_scene(**description(lights=[light]))).receipt.rays["shadow"]
    assert abs(rays - PATHS / 2) < 6 * np.sqrt(PATHS / 4)


@pytest.mark.parametrize("material", [{"color": 0}, {"diffuse": 0}, {"color": 0, "mirror": 1}])
@pytest.mark.parametrize("light", [PANEL | {"samples": "grid 3"}, BALL, BALL | {"samples": "ball"}])
def test_black_surfaces_ask_for_no_light(
    make_scene: MakeScene, material: dict[str, Any], light: dict[str, Any]
) -> None:
    scene = make_scene(
        **description(materials={"grey": material}, lights=[light | {"intensity": 1}])
    )
    receipt = render(scene).receipt
    assert receipt.rays["shadow"] == 0
    assert set(receipt.numbers) == {"pixel"}
    assert "diffuse or specular" in receipt.effects["skipped"]["light 0"]
    assert "soft_shadows" not in scene.effects.imported


@pytest.mark.parametrize("gloss", [None, GLOSS])
def test_throughput_below_the_cutoff_scatters_nothing(make_scene: MakeScene, gloss: Any) -> None:
    # 0.2 at the first bounce, 0.04 at the second one between two walls.
    behind = WALL | {"transform": [*WALL["transform"], {"translate": [0, 0, 6]}]}
    scene = make_scene(
        **description(
            objects=[WALL, behind],
            materials={"grey": {"mirror": 0.2, "gloss": gloss}},
            integrator={"cutoff": 0.1, "max_depth": 9},
        )
    )
    receipt = render(scene).receipt
    assert receipt.rays["reflection"] == PATHS
    assert receipt.numbers == {"pixel": 2 * PATHS} | ({"gloss": 2 * PATHS} if gloss else {})


def test_only_the_rays_of_glossy_materials_draw_for_them(make_scene: MakeScene) -> None:
    # The left half of the picture is a glossy mirror, the right half a perfect one.
    half = {"shape": "quad", "width": 50, "depth": 100}
    objects = [
        half | {"material": name}
        | {"transform": [*WALL["transform"], {"translate": [side * 25, 0, 0]}]}
        for name, side in (("rough", -1), ("sharp", 1))
    ]  # fmt: skip
    materials = {"rough": {"mirror": 0.5, "gloss": GLOSS}, "sharp": {"mirror": 0.5}}
    receipt = render(make_scene(**description(objects=objects, materials=materials))).receipt
    assert receipt.rays["reflection"] == PATHS
    assert receipt.numbers["gloss"] == PATHS


@pytest.mark.parametrize(
    ("light", "material"),
    [
        (POINT | {"intensity": 0} | MOVES, {}),
        (BALL | {"intensity": [0, 0, 0]} | MOVES, {}),
        (BALL | MOVES, {"diffuse": 0}),
        (PANEL | {"intensity": 1} | MOVES, {"color": 0}),
    ],
    ids=["no power", "black", "nothing diffuse", "nothing coloured"],
)
def test_a_moving_light_that_lights_nothing_moves_nothing(
    make_scene: MakeScene, light: dict[str, Any], material: dict[str, Any]
) -> None:
    scene = make_scene(**description(lights=[light], materials={"grey": material}))
    receipt = render(scene).receipt
    assert "time" not in receipt.numbers
    assert "motion_blur" not in scene.effects.imported
    assert "motion_blur" in receipt.effects["skipped"]


def test_a_glossy_mirror_below_the_cutoff_is_no_mirror(make_scene: MakeScene) -> None:
    # No path can ever be reflected by it, so nothing is imported for it, and nothing said to be called.
    materials = {"grey": {"mirror": 0.001, "gloss": GLOSS}}
    scene = make_scene(**description(materials=materials, integrator={"cutoff": 0.01}))
    receipt = render(scene).receipt
    assert receipt.rays["reflection"] == 0
    assert set(receipt.numbers) == {"pixel"}
    assert "glossy" not in scene.effects.imported
    assert "glossy" in receipt.effects["skipped"]
