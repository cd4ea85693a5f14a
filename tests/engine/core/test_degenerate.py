"""Each effect turned down to nothing is the simpler thing, bit for bit.

Where two effects draw numbers they also move each other's dimensions, so what is compared differs in one effect only,
and the simpler scene needs none of its numbers.
"""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.engine.core.counters import Counters
from course.engine.core.rays import Draws, Rays
from course.engine.core.samplers import Block
from course.engine.render.binding import bind
from tests.conftest import MakeScene
from tests.lengths import fewer

BALL = {"shape": "sphere", "material": "grey", "radius": 0.6, "segments": 32} | {
    "transform": [{"translate": [-0.6, 0.7, 0]}]
}
BOX = {"shape": "box", "material": "mirror"} | {"transform": [{"translate": [0.7, 0.613, -0.5]}]}
FLOOR = {"shape": "quad", "material": "grey", "width": 5, "depth": 5}
SPHERE = {"type": "sphere", "center": [0.4, 3, 1.3], "radius": 0.5, "intensity": [9, 7, 4]}
LAMP = {"type": "rectangle", "corner": [-2, 2.5, 1], "edge_u": [0.7, 0, 0]} | {
    "edge_v": [0, 0, 0.9],
    "radiance": 2,
}
CAMERA = {"eye": [0.5, 1.7, 4], "look_at": [0, 0.5, 0]}


@pytest.fixture
def room(make_scene: MakeScene) -> MakeScene:
    """A ball, a mirror and shadows, under an area light."""

    def make(**parts: Any) -> Scene:
        description: dict[str, Any] = {
            "camera": CAMERA,
            "film": {"width": 40, "height": 30},
            "environment": {"type": "constant", "radiance": [0.1, 0.2, 0.3]},
            "materials": {"grey": {"specular": 0.3}, "mirror": {"mirror": 0.7, "color": 0.2}},
            "objects": [FLOOR, BALL, BOX],
            "lights": [LAMP],
        }
        return make_scene(**(description | parts))

    return make


def same(a: Scene, b: Scene, **options: Any) -> None:
    one, other = render(a, **options), render(b, **options)
    assert one.linear.std() > 0.05
    assert np.array_equal(one.linear, other.linear)
    assert one.receipt.rays == other.receipt.rays
    assert one.receipt.numbers == other.receipt.numbers


@fewer
@pytest.mark.parametrize("sampler", ["sobol", "random", "jittered", "regular"])
@pytest.mark.parametrize("shape", ["disk", "square", "polygon"])
def test_an_aperture_of_0_is_the_pinhole(room: MakeScene, shape: str, sampler: str) -> None:
    lens = {"aperture_radius": 0, "focus_distance": 3, "shape": shape}
    same(room(camera=CAMERA | {"lens": lens}), room(), sampler=sampler)
    # The lens's own formula agrees where it is called: at its centre.
    small = room(camera=CAMERA | {"lens": lens | {"aperture_radius": 0.2}})
    camera = bind(small, small.settings).integrator.camera
    optics = small.compiled.world.lens
    assert optics is not None
    directions = camera.directions(*np.random.default_rng(1).random((2, 999), np.float32) * 30)
    origin, turned = optics.thin_lens.lens_rays(
        camera.origin,
        camera.right,
        camera.up,
        camera.forward,
        directions,
        np.zeros((2, 999), np.float32),
        optics.focus_distance,
    )
    # To rounding: a textbook's formula is four units in the last place off, and isn't called where there is no lens.
    assert np.abs(turned - directions).max() <= 4 * np.finfo(np.float32).eps
    assert np.array_equal(origin, np.broadcast_to(camera.origin[:, None], origin.shape))
    assert not np.array_equal(render(small).linear, render(room()).linear)


@pytest.mark.parametrize("method", ["sphere", "ball", "facing disk"])
def test_a_sphere_of_radius_0_is_a_point_light(room: MakeScene, method: str) -> None:
    point = {"type": "point", "position": SPHERE["center"], "intensity": SPHERE["intensity"]}
    for lights in ([], [LAMP]):
        sphere = SPHERE | {"radius": 0, "samples": method}
        same(room(lights=[sphere, *lights]), room(lights=[point, *lights]))
    assert not np.array_equal(
        render(room(lights=[SPHERE])).linear, render(room(lights=[point])).linear
    )


@pytest.mark.parametrize(
    ("sharp", "blurred"),
    [
        ({"lobe": "plane", "roughness": 0}, {"lobe": "plane", "roughness": 0.2}),
        ({"lobe": "ball", "glossiness": 0}, {"lobe": "ball", "glossiness": 0.2}),
    ],
)
def test_no_roughness_is_the_mirror(
    room: MakeScene, sharp: dict[str, Any], blurred: dict[str, Any]
) -> None:
    def with_gloss(gloss: Any) -> Scene:
        mirror = {"mirror": 0.7, "color": 0.2, "gloss": gloss}
        return room(materials={"grey": {"specular": 0.3}, "mirror": mirror})

    same(with_gloss(sharp), with_gloss(None))
    assert not np.array_equal(render(with_gloss(blurred)).linear, render(with_gloss(None)).linear)


def moving(
    room: MakeScene, velocity: list[float], shutter: dict[str, float], **parts: Any
) -> Scene:
    """Ball, mirror, light and camera all move, each at its own multiple of a velocity."""
    v = np.array(velocity)

    def at(share: float) -> dict[str, Any]:
        return {"motion": {"velocity": (share * v).tolist()}}

    camera = CAMERA | at(0.25) | {"shutter": shutter}
    objects = [FLOOR, BALL | at(1), BOX | at(-0.5)]
    return room(camera=camera, objects=objects, lights=[LAMP | at(0.75), SPHERE | at(2)], **parts)


@pytest.mark.parametrize("sampler", ["sobol", "random"])
def test_no_velocity_is_the_still(room: MakeScene, sampler: str) -> None:
    still = room(lights=[LAMP, SPHERE])
    same(moving(room, [0, 0, 0], {"open": 0, "close": 1}), still, sampler=sampler)
    same(moving(room, [0, 0, 0], {"open": 7, "close": 9.5}), still, sampler=sampler)
    moved = render(moving(room, [0.3, 0.1, 0], {"open": 0, "close": 1}), sampler=sampler)
    assert not np.array_equal(moved.linear, render(still, sampler=sampler).linear)


def test_a_closed_shutter_at_time_0_is_the_still(room: MakeScene) -> None:
    closed = moving(room, [0.3, 0.1, -0.2], {"open": 0, "close": 0})
    same(closed, room(lights=[LAMP, SPHERE]))


def moved(thing: dict[str, Any], by: NDArray[np.float64]) -> dict[str, Any]:
    places = {
        key: (np.array(thing[key]) + by).tolist()
        for key in ("corner", "center", "eye", "look_at")
        if key in thing
    }
    if "transform" in thing:
        places["transform"] = [*thing["transform"], {"translate": by.tolist()}]
    return thing | places


@pytest.mark.parametrize("t", [2.5, -1.0])
def test_a_closed_shutter_at_another_time_is_everything_moved_there(
    room: MakeScene, t: float
) -> None:
    v = np.array([0.16, 0.08, -0.12])
    closed = moving(room, v.tolist(), {"open": t, "close": t})
    still = room(
        camera=moved(CAMERA, 0.25 * v * t),
        objects=[FLOOR, moved(BALL, v * t), moved(BOX, -0.5 * v * t)],
        lights=[moved(LAMP, 0.75 * v * t), moved(SPHERE, 2 * v * t)],
    )
    one, other = render(closed), render(still)
    assert one.receipt.numbers == other.receipt.numbers
    # Positions are the same but for the order of additions in float64, hardly ever seen in float32.
    different = np.abs(one.linear - other.linear).max(axis=2)
    assert (different > 1e-5).sum() <= 3
    assert different.mean() < 1e-4
    assert not np.allclose(one.linear, render(room(lights=[LAMP, SPHERE])).linear, atol=0.01)


def test_one_regular_sample_is_the_pixels_centre(room: MakeScene) -> None:
    scene = room(
        sampler={"type": "regular", "samples": 1},
        lights=[{"type": "point", "position": [1, 3, 1], "intensity": 9}],
    )
    shown = render(scene).linear
    tracer = bind(scene, scene.settings)
    x, y = np.meshgrid(np.arange(40, dtype=np.float32) + 0.5, np.arange(30, dtype=np.float32) + 0.5)
    rays = Rays(
        tracer.integrator.camera.origin[:, None],
        tracer.integrator.camera.directions(x.ravel(), y.ravel()),
        None,
        None,
    )
    block = Block(np.arange(1200, dtype=np.uint32), 0, 1, 0)
    draws = Draws(tracer.sampler, tracer.dimensions, block, Counters())
    by_hand = tracer.integrator.radiance(rays, draws)
    assert np.array_equal(shown, by_hand.reshape(3, 30, 40).transpose(1, 2, 0))
    assert not draws.counters.numbers, "no other number is drawn"
    # Nothing of it is random.
    assert np.array_equal(shown, render(scene, seed=99).linear)
    assert not np.array_equal(shown, render(scene, sampler="random").linear)


def test_one_regular_sample_is_the_middle_of_lens_light_and_shutter(room: MakeScene) -> None:
    # At the centres of all their ranges: a pinhole, at half time, with the light's middle.
    lens = {"aperture_radius": 0.2, "focus_distance": 3, "shape": "square"}
    one = {"type": "regular", "samples": 1}
    floor = {"shape": "quad", "material": "grey", "width": 8, "depth": 8}
    light = LAMP | {"radiance": None, "intensity": 4}
    full = room(camera=CAMERA | {"lens": lens}, sampler=one, objects=[floor, BALL], lights=[light])
    middle = np.add([-2, 2.5, 1], [0.35, 0, 0.45])
    plain = room(
        sampler=one,
        objects=[floor, BALL],
        lights=[{"type": "point", "position": middle.tolist(), "intensity": 4}],
    )
    assert np.allclose(render(full).linear, render(plain).linear, atol=1e-5)


@pytest.mark.parametrize("kind", ["intensity", "radiance"])
def test_a_grid_of_1_is_the_point_at_the_centre(make_scene: MakeScene, kind: str) -> None:
    # All numbers are short in binary, and the scene's half extent is 4: positions are exact in any order.
    grid = {"type": "rectangle", "corner": [-1.5, 3, 0.5], "edge_u": [1, 0, 0.5]} | {
        "edge_v": [0.5, 0, 1.25],
        "samples": "grid 1",
    }
    parts: dict[str, Any] = {
        "camera": {"eye": [0.5, 2, 4], "look_at": [0, 0, 0]},
        "objects": [
            FLOOR | {"width": 8, "depth": 8},
            BALL | {"transform": [{"translate": [-0.5, 0.75, 0]}], "radius": 0.5},
        ],
        "materials": {"grey": {"specular": 0.3}},
    }
    if kind == "intensity":
        point = {"type": "point", "position": [-0.75, 3, 1.375], "intensity": [8, 4, 2]}
        one = make_scene(**parts, lights=[grid | {"intensity": [8, 4, 2]}])
        same(one, make_scene(**parts, lights=[point]))
        return
    # By radiance it is the middle of the light, which one regular sample of `point` takes too.
    light = grid | {"radiance": 3}
    one = {"type": "regular", "samples": 1}
    lit = render(make_scene(**parts, sampler=one, lights=[light])).linear
    middle = make_scene(**parts, sampler=one, lights=[light | {"samples": "point"}])
    assert np.array_equal(lit, render(middle).linear)
    assert lit.max() > 0.1
