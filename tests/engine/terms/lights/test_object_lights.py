"""Objects that are lights: sampled at every hit, seen from both sides, and never counted twice.

Where there is no noise, the tolerance is that of float32 sums. Else pixels of the random sampler are independent
estimates of one number, whose mean is within 5.33 of its standard errors (false-fail rate 1e-7 for each of the about 60
such numbers, 6e-6 for the file).
"""

import math
from typing import Any

import numpy as np
import pytest

from benchmarks.mitsuba_export import NotExportableError, export
from course import render
from course.engine.radiosity.patches import make_patches
from tests.conftest import MakeScene
from tests.engine.terms.lights.over_a_floor import (
    DISTRIBUTION,
    DOWN,
    LISTED,
    PANEL,
    PATHS,
    POINT,
    RECTANGLE,
    UP,
    WALL,
    assert_mean,
    both,
    lamps,
    over_a_floor,
    panel,
    share,
)
from tests.forms import needs_numba
from tests.lengths import fewer

LIGHTS = pytest.mark.parametrize("lights", [[LISTED], []], ids=["a light", "glowing"])
"""Listed as a light, or only glowing: by paths both bring the same."""

each_form = pytest.mark.usefixtures("each_form")


# ---------------------------------------------------------------- what it lights


@both
@pytest.mark.parametrize("steps", [[DOWN], []], ids=["front", "back"])
def test_a_square_lights_by_its_form_factor(
    make_scene: MakeScene, steps: list[dict[str, Any]], integrator: dict[str, Any]
) -> None:
    picture = render(over_a_floor(make_scene, [panel(*steps)], [LISTED], integrator))
    assert_mean(picture, 0.5 * 3 * share())
    assert picture.receipt.rays["shadow"] == 64 * 64 * 16


def test_a_square_is_as_the_light_of_type_rectangle_is(make_scene: MakeScene) -> None:
    pictures = [
        render(over_a_floor(make_scene, [panel()], [LISTED], DISTRIBUTION)),
        render(over_a_floor(make_scene, [], [RECTANGLE | {"radiance": 3}], DISTRIBUTION)),
    ]
    means, errors = zip(
        *((x.mean(), x.std() / 64) for x in (p.linear[..., 0].astype(float) for p in pictures)),
        strict=True,
    )
    assert abs(means[0] - means[1]) < 5.33 * math.hypot(*errors)


@both
def test_a_ball_lights_as_if_all_came_from_its_centre(
    make_scene: MakeScene, integrator: dict[str, Any]
) -> None:
    """Above the horizon E = pi L (r / d)^2 cos. Half its triangles face away, and bring nothing."""
    ball = panel(shape="sphere", radius=0.3, segments=128)
    middle = np.array(UP["translate"]) - POINT
    d = np.linalg.norm(middle)
    picture = render(over_a_floor(make_scene, [ball], [LISTED], integrator))
    assert_mean(picture, 0.5 * 3 * (0.3 / d) ** 2 * middle[1] / d, offset=1e-3)


def test_many_triangles_of_all_sizes_light_as_paths_find_them(make_scene: MakeScene) -> None:
    """A bent body that hides parts of itself; no closed form, so both ways are compared."""
    knot = panel(shape="torus_knot", radius=0.35, tube=0.08, segments=128, sides=12)
    pictures = [
        render(over_a_floor(make_scene, [knot], lights, PATHS)).linear[..., 0].astype(float)
        for lights in ([LISTED], [])
    ]
    error = math.hypot(*(x.std() / 64 for x in pictures))
    assert abs(pictures[0].mean() - pictures[1].mean()) < 5.33 * error
    assert error < 0.03 * pictures[1].mean()


def test_far_away_a_thin_box_shines_from_the_near_side_alone(make_scene: MakeScene) -> None:
    """Twelve from a plate of a thousandth: shadow rays to the far side have to stop in time."""
    plate = PANEL | {
        "shape": "box",
        "size": [1, 0.001, 1],
        "transform": [{"translate": [0.7, 12, 0]}],
    }
    assert_mean(
        render(over_a_floor(make_scene, [plate], [LISTED], DISTRIBUTION)),
        0.5 * 3 * share(y=11.9995),
        offset=1e-3,
    )


@both
def test_a_moving_lamp_is_sampled_where_it_stands_at_the_time(
    make_scene: MakeScene, integrator: dict[str, Any]
) -> None:
    camera = {"eye": [2.5, 0.8, 0.1], "look_at": POINT.tolist(), "vertical_fov": 0.01}
    moving = panel(motion={"velocity": [3, 0, 0]})
    camera = camera | {"shutter": {"open": 0.2, "close": 1}}
    scene = over_a_floor(make_scene, [moving], [LISTED], integrator, camera=camera)
    times = 0.2 + 0.8 * (np.arange(200) + 0.5) / 200
    assert_mean(render(scene), 0.5 * 3 * float(np.mean([share(0.2 + 3 * t) for t in times])))


# ---------------------------------------------------------------- what is seen


@fewer
@each_form
@both
@LIGHTS
@pytest.mark.parametrize("eye", [[0.7, 0.2, 0], [0.7, 3, 0.001]], ids=["back", "front"])
def test_the_camera_sees_both_sides(
    make_scene: MakeScene,
    integrator: dict[str, Any],
    lights: list[dict[str, Any]],
    eye: list[float],
) -> None:
    camera = {"eye": eye, "look_at": [0.7, 1, 0], "up": [0, 0, 1], "vertical_fov": 1}
    scene = over_a_floor(make_scene, [panel()], lights, integrator, camera=camera)
    assert (render(scene).linear == 3).all()


@fewer
@each_form
@both
@lamps
def test_a_mirror_shows_it_by_its_reflectance(
    make_scene: MakeScene, integrator: dict[str, Any], objects: Any, lights: Any
) -> None:
    camera = {"eye": [2.5, 0.3, 0.1], "look_at": [-0.7, 1, 0], "vertical_fov": 0.01}
    scene = over_a_floor(make_scene, [*objects, WALL], lights, integrator, camera=camera)
    assert np.allclose(render(scene).linear, 3 * 0.8, rtol=1e-6)


@both
@LIGHTS
def test_glass_shows_it_by_what_it_lets_through(
    make_scene: MakeScene, integrator: dict[str, Any], lights: list[dict[str, Any]]
) -> None:
    """Straight through a pane: (1 - r) / (1 + r) of it, r = 0.04, by all reflections between its faces."""
    pane = {"shape": "box", "material": "glass", "size": [5, 0.1, 5], "transform": [UP]}
    materials = {
        "panel": {"color": 0, "emission": 3},
        "floor": {"color": 0},
        "glass": {"color": 0, "dielectric": {"refraction_index": 1.5}},
    }
    camera = {"eye": [0.7, 0.2, 0], "look_at": [0.7, 1, 0], "up": [0, 0, 1], "vertical_fov": 0.01}
    lamp = PANEL | {"width": 9, "depth": 9, "transform": [{"translate": [0, 2, 0]}]}
    parts: dict[str, Any] = {"materials": materials, "camera": camera}
    deep = integrator | {"max_depth": 9, "cutoff": 0}
    scene = over_a_floor(make_scene, [lamp, pane], lights, deep, **parts)
    expected = 3 * (1 - 0.04) / (1 + 0.04)
    if integrator is PATHS:
        assert_mean(render(scene), expected)
    else:
        assert np.allclose(render(scene).linear, expected, rtol=1e-3)


def test_a_round_lamp_is_not_lit_by_itself(make_scene: MakeScene) -> None:
    """Though it reflects most of the light, and its triangles stand at angles that its normals hide."""
    ball = PANEL | {"shape": "sphere", "segments": 24}
    scene = over_a_floor(
        make_scene,
        [ball],
        [LISTED],
        PATHS,
        objects=[ball],
        materials={"panel": {"color": 0.8, "emission": 1}},
        camera={"eye": [0, 0, 6], "look_at": [0, 0, 0], "vertical_fov": 13},
    )
    picture = render(scene)
    assert picture.receipt.rays["shadow"] > 0
    assert (picture.linear == 1).all()


# ---------------------------------------------------------------- counted once


@each_form
@lamps
def test_the_floor_has_its_light_once_and_its_mirror_images_once(
    make_scene: MakeScene, objects: Any, lights: Any
) -> None:
    """By shadow rays or by paths the lamp, by paths over the mirror its image in it."""
    film = {"width": 96, "height": 96}
    scene = over_a_floor(make_scene, [*objects, WALL], lights, PATHS, film=film)
    assert_mean(render(scene), 0.5 * 3 * (share() + 0.8 * share(x=-1.2)))


@fewer
@each_form
@lamps
@pytest.mark.parametrize("roulette", [None, 1])
def test_a_surface_that_also_mirrors_has_its_light_once(
    make_scene: MakeScene, objects: Any, lights: Any, roulette: int | None
) -> None:
    materials = {
        "floor": {"color": 0.5, "mirror": 0.3},
        "panel": {"color": 0, "emission": 3},
        "mirror": {},
    }
    paths = PATHS | {"roulette": roulette}
    scene = over_a_floor(make_scene, objects, lights, paths, materials=materials)
    assert_mean(render(scene), 0.5 * 3 * share())


@fewer
@each_form
@pytest.mark.parametrize(("kind", "roulette"), [("listed", None), ("glows", None), ("sphere", 1)])
def test_a_lamp_inside_a_ball_lights_it_once(
    make_scene: MakeScene, kind: str, roulette: int | None
) -> None:
    """A black lamp of radius a in a ball of radius 1: E = pi L a^2, and it swallows a^2 of what the walls send out.

    Shadow rays find the lamp at every hit; a path that runs into it must not add it again, nor shine through it.
    """
    a, r = 0.4, 0.6
    room = {"shape": "sphere", "material": "floor", "radius": 1, "segments": 128}
    lamp = PANEL | {"shape": "sphere", "radius": a, "segments": 128}
    sphere = {"type": "sphere", "center": [0, 0, 0], "radius": a, "radiance": 1}
    scene = over_a_floor(
        make_scene,
        [],
        {"listed": [LISTED], "glows": [], "sphere": [sphere]}[kind],
        PATHS | {"roulette": roulette},
        objects=[room] if kind == "sphere" else [room, lamp],
        materials={"floor": {"color": r}, "panel": {"color": 0, "emission": 1}},
        camera={"eye": [0.5, 0.3, 0.3], "look_at": [1, 0.6, 0.6], "vertical_fov": 70},
    )
    assert_mean(render(scene), r * a * a / (1 - r * (1 - a * a)), offset=1e-3)


@pytest.mark.parametrize("reflectance", [0.3, 0.8])
def test_walls_that_are_the_light_add_up_every_reflection(
    make_scene: MakeScene, reflectance: float
) -> None:
    """A closed ball, 1 + r + r^2 + ...; by shadow rays all but the first."""
    ball = {"shape": "sphere", "name": "ball", "material": "m", "segments": 64, "shading": "flat"}
    scene = over_a_floor(
        make_scene,
        [],
        [{"type": "object", "object": "ball"}],
        PATHS | {"max_depth": 70},
        objects=[ball],
        materials={"m": {"color": reflectance, "emission": 1}},
        camera={"eye": [0.1, 0.05, 0.2], "look_at": [1, 0.3, 0.2], "vertical_fov": 70},
        film={"width": 24, "height": 24},
    )
    assert_mean(render(scene), 1 / (1 - reflectance))


@both
def test_another_object_of_the_material_only_glows(
    make_scene: MakeScene, integrator: dict[str, Any]
) -> None:
    """Beside the light, and alike: no shadow ray looks for it, and paths find it."""
    other = PANEL | {"name": "other", "transform": [{"translate": [-0.7, 1, 0]}]}
    scene = over_a_floor(make_scene, [panel(), other], [LISTED], integrator)
    found = share(x=-1.2) if integrator is PATHS else 0
    assert_mean(render(scene, spp=64), 0.5 * 3 * (share() + found))


@each_form
@LIGHTS
def test_a_light_of_another_kind_beside_it_counts_once_as_well(
    make_scene: MakeScene, lights: list[dict[str, Any]]
) -> None:
    rectangle = RECTANGLE | {"corner": [-1.2, 1, -0.5], "radiance": 7}
    scene = over_a_floor(make_scene, [panel()], [rectangle, *lights], PATHS)
    assert_mean(render(scene, spp=64), 0.5 * (3 * share() + 7 * share(x=-1.2)))


# ---------------------------------------------------------------- contract of the engine


@needs_numba
@both
def test_compiled_loops_give_the_same_bits(
    make_scene: MakeScene, integrator: dict[str, Any]
) -> None:
    scene = over_a_floor(make_scene, [panel(shape="box"), WALL], [LISTED], integrator)
    with_them, without = (render(scene, compiled=c).linear for c in (True, False))
    assert with_them.tobytes() == without.tobytes()


def test_the_receipt_counts_its_numbers(make_scene: MakeScene) -> None:
    picture = render(over_a_floor(make_scene, [panel()], [LISTED], DISTRIBUTION), spp=4)
    assert picture.receipt.numbers["light 0"] == 3 * 4 * 64 * 64


# ---------------------------------------------------------------- others that read scenes


def test_radiosity_takes_it_as_what_glows(make_scene: MakeScene) -> None:
    materials = {"floor": {"color": 0.5}, "panel": {"color": 0, "emission": 3}}
    lit, glowing = (
        make_patches(
            over_a_floor(make_scene, [panel()], lights, DISTRIBUTION, materials=materials), 100
        )
        for lights in ([LISTED], [])
    )
    assert lit.emission.max() == pytest.approx(3 * math.pi)
    assert np.array_equal(lit.emission, glowing.emission)
    assert np.array_equal(lit.back_emission, glowing.back_emission)


def test_a_scene_with_an_object_light_is_not_exported_to_mitsuba(make_scene: MakeScene) -> None:
    scene = over_a_floor(make_scene, [panel()], [LISTED], PATHS)
    with pytest.raises(NotExportableError, match="emission is not exported"):
        export(scene, 8, 8)
