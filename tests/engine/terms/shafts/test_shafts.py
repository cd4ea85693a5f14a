"""Shadow rays that aren't sent: shafts are right about each of them, and pictures keep their bits."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from course.engine.render.binding import bind
from course.engine.terms.shafts.stage import sparing
from tests.engine.terms.shafts.scenes import (
    FLAT,
    FLOOR,
    MakeScene,
    random_scene,
    rendered,
    sent,
    with_shafts,
    without_shafts,
)

SEEDS = range(12)


@pytest.mark.parametrize("seed", SEEDS)
def test_spared_rays_that_are_sent_all_the_same_find_what_their_shafts_say(
    seed: int, make_scene: MakeScene
) -> None:
    told = sent(random_scene(make_scene, seed), pixels=2.0)
    assert told.wrong == 0


def test_random_scenes_have_shafts_of_both_kinds(make_scene: MakeScene) -> None:
    told = [sent(random_scene(make_scene, seed), pixels=2.0) for seed in range(4)]
    assert sum(each.clear for each in told) > 20_000
    assert sum(each.cut for each in told) > 100


def test_cells_of_a_lamp_that_have_one_name_have_a_shaft_each(make_scene: MakeScene) -> None:
    lamp = {"type": "rectangle", "corner": [-2, 3, -2], "edge_u": [4, 0, 0], "edge_v": [0, 0, 4]}
    lamp |= {"intensity": 9, "samples": "grid 3"}
    roof = {"shape": "quad", "material": "floor", "width": 2, "depth": 2}
    roof |= {"transform": [{"translate": [0.5, 1.5, 0]}]}
    scene = make_scene(**FLOOR | {"lights": [lamp], "objects": [FLAT, roof]})
    told = sent(scene, pixels=2.0)
    assert told.clear > 1000
    assert told.cut > 1000
    assert told.wrong == 0


@pytest.mark.parametrize("seed", range(3))
def test_pictures_keep_their_bits(seed: int, make_scene: MakeScene) -> None:
    tracer = with_shafts(random_scene(make_scene, seed), pixels=2.0)
    spared, counters = rendered(tracer)
    whole, every = rendered(without_shafts(tracer))
    assert np.array_equal(spared, whole)
    told = counters.spared["clear"] + counters.spared["cut off"]
    assert told > 0
    assert counters.rays["shadow"] + told == every.rays["shadow"]


@pytest.mark.parametrize("below", [False, True], ids=["from the front", "from behind"])
def test_nothing_is_sent_where_nothing_can_block(below: bool, make_scene: MakeScene) -> None:
    height = -2 if below else 2
    lamp = {"type": "sphere", "center": [1, height, 0], "radius": 0.3, "intensity": 9}
    camera = FLOOR["camera"] | {"eye": [0, 1.5 * height, 6]}
    scene = make_scene(**FLOOR | {"camera": camera, "lights": [lamp], "objects": [FLAT]})
    _, counters = rendered(with_shafts(scene))
    assert counters.spared["clear"] > 10_000
    assert counters.rays["shadow"] == 0


def test_nothing_is_sent_into_the_shadow_of_one_large_triangle(make_scene: MakeScene) -> None:
    lamp = {"type": "sphere", "center": [0, 9, 0], "radius": 0.2, "intensity": 9}
    roof = {"shape": "quad", "material": "floor", "width": 90, "depth": 90}
    roof["transform"] = [{"translate": [20, 6, -10]}]
    scene = make_scene(**FLOOR | {"lights": [lamp], "objects": [FLAT, roof]})
    _, counters = rendered(with_shafts(scene))
    # The seam between the roof's triangles is not seen: it runs from corner to corner, far away from the lamp.
    assert counters.spared["cut off"] > 10_000
    assert counters.rays["shadow"] == 0


def test_a_lamp_that_touches_its_own_surface_is_asked(make_scene: MakeScene) -> None:
    """A lamp half below the floor: rays to its upper half are free, and leave the floor at any angle."""
    lamp = {"type": "sphere", "center": [0, 0, 0], "radius": 0.5, "intensity": 9}
    scene = make_scene(**FLOOR | {"lights": [lamp], "objects": [FLAT]})
    tracer = with_shafts(scene)
    assert np.array_equal(rendered(tracer)[0], rendered(without_shafts(tracer))[0])


@pytest.mark.parametrize("factor", [-20.0, 1.5, 40.0])
def test_points_that_a_function_puts_anywhere_are_asked_for(
    factor: float, make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch
) -> None:
    lamp = {"type": "sphere", "center": [2, 2, 0], "radius": 0.1, "intensity": 9}
    wall = {"shape": "box", "material": "floor", "size": [0.1, 3, 3]}
    wall["transform"] = [{"translate": [2.6, 1.6, 0]}]
    scene = make_scene(**FLOOR | {"lights": [lamp], "objects": [FLAT, wall]})
    tracer = with_shafts(scene)
    light: Any = tracer.integrator.direct.lights[0]  # type: ignore[union-attr]
    right = light.soft_shadows.point_on_sphere

    def wrong(center: Any, radius: float, u: Any) -> Any:
        return right(center, abs(factor) * radius, u) + np.float32(factor * radius)

    monkeypatch.setattr(light.soft_shadows, "point_on_sphere", wrong)
    spared, counters = rendered(tracer)
    assert np.array_equal(spared, rendered(without_shafts(tracer))[0])
    assert counters.rays["shadow"] > 0


def test_one_pixel(make_scene: MakeScene) -> None:
    scene = random_scene(make_scene, 1, film={"width": 1, "height": 1})
    tracer = with_shafts(scene)
    assert np.array_equal(rendered(tracer)[0], rendered(without_shafts(tracer))[0])


def test_times_outside_the_exposure_are_asked_for(make_scene: MakeScene) -> None:
    """A student's shutter may be open when it isn't: a mover is then where no box of it is."""
    lamp = {"type": "sphere", "center": [0, 4, 0], "radius": 0.2, "intensity": 9}
    ball = {"shape": "sphere", "material": "floor", "radius": 0.8}
    ball |= {"transform": [{"translate": [-1, 1, 0]}], "motion": {"velocity": [1, 0, 0]}}
    tracer = with_shafts(make_scene(**FLOOR | {"lights": [lamp], "objects": [FLAT, ball]}))
    motion: Any = tracer.integrator.motion

    def late(_open: float, _close: float, u: Any) -> Any:
        return np.where(u < 0.9, u / 2, 1.9).astype(np.float32)

    motion.motion_blur.shutter_times = late
    spared, counters = rendered(tracer)
    assert counters.spared["clear"] > 0
    assert np.array_equal(spared, rendered(without_shafts(tracer))[0])


@pytest.mark.parametrize(
    ("width", "segments", "has"), [(40, 8, False), (400, 8, True), (400, 500, False)]
)
def test_small_pictures_and_those_of_many_triangles_have_none(
    width: int, segments: int, has: bool, make_scene: MakeScene
) -> None:
    lamp = {"type": "sphere", "center": [0, 4, 0], "radius": 0.2, "intensity": 9}
    ball = {"shape": "sphere", "material": "floor", "radius": 0.8, "segments": segments}
    scene = make_scene(**FLOOR | {"lights": [lamp], "objects": [FLAT, ball]})
    tracer = bind(scene, replace(scene.settings, width=width, height=300))
    direct = sparing(tracer).integrator.direct
    assert direct is not None
    assert (direct.spare is not None) == has
