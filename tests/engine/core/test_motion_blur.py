"""Motion blur: each pixel shows the average, over the time that the shutter is open, of what is there at each moment.

Bars taller than the picture move across it before a camera for which 1 pixel is 1/16 at the plane z = 0. What a
column shows is the average over its width and the time of a colour that a few lines of float64 say: for one bar that
is a trapezoid. The rows of a column are independent, so with N = rows x samples a mean of colours between 0 and 1 is
within 5 sqrt(p (1 - p) / N) + 10 / N with a false-fail rate below 1e-6 (Bernstein) for random samples, and far less
for Sobol points, which are spread more evenly; the quadrature, 64 x 1024 midpoints, adds at most 1 / 256. About 3000
columns are tested.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.base.errors import CourseWarning
from tests.conftest import MakeScene

Array = NDArray[np.float64]
SIZE = 32
SAMPLES = 64
CAMERA = {"eye": [0, 0, 4], "look_at": [0, 0, 0]} | {
    "vertical_fov": math.degrees(2 * math.atan(1 / 4))
}
UPRIGHT = {"rotate": {"axis": [1, 0, 0], "degrees": 90}}
WHITE = {"type": "ambient", "radiance": 1}
MATERIALS = {
    name: {"color": color, "diffuse": 0}
    for name, color in (
        ("red", [1, 0, 0]),
        ("green", [0, 1, 0]),
        ("blue", [0, 0, 1]),
        ("white", [1, 1, 1]),
        ("black", [0, 0, 0]),
    )
} | {"matt": {"color": 1}, "mirror": {"mirror": 1}}


def bar(
    x0: float, x1: float, z: float, velocity: float | list[float] = 0.0, material: str = "red"
) -> dict[str, Any]:
    v = velocity if isinstance(velocity, list) else [velocity, 0, 0]
    quad = {"shape": "quad", "material": material, "width": x1 - x0, "depth": 40}
    place = [UPRIGHT, {"translate": [(x0 + x1) / 2, 0, z]}]
    return quad | {"transform": place, "motion": {"velocity": v}}


def still(make_scene: MakeScene, *objects: dict[str, Any], **parts: Any) -> Scene:
    camera = CAMERA | parts.pop("camera", {})
    description = {
        "camera": camera,
        "film": {"width": SIZE, "height": SIZE},
        "sampler": {"type": "sobol", "samples": SAMPLES},
        "materials": MATERIALS,
        "objects": list(objects),
        "lights": [WHITE],
    }
    return make_scene(**(description | parts))


Colour = Callable[[Array, Array], Array]


def average(colour: Colour, begin: float = 0.0, end: float = 1.0) -> Array:
    """(SIZE, C) mean over each column's width, at z = 0, and the time; colour(x, t) -> (..., C)."""
    fine = (np.arange(64) + 0.5) / 64
    t = begin + (end - begin) * (np.arange(1024) + 0.5) / 1024
    x = (np.arange(SIZE)[:, None, None] + fine[:, None]) / (SIZE / 2) - 1
    return np.stack([colour(column, t[None, :]).mean(axis=(0, 1)) for column in x])


def inside(x: Array, x0: float, x1: float, shift: Array | float = 0.0) -> Array:
    return np.asarray((x - shift > x0) & (x - shift < x1))


def agree(scene: Scene, p: Array, sampler: str = "sobol") -> None:
    shown = render(scene, sampler=sampler).linear.astype(np.float64).mean(axis=0)[:, : p.shape[1]]
    n = SIZE * SAMPLES
    assert ((p > 0.02) & (p < 0.98)).any(), "something moves"
    bound = 5 * np.sqrt(np.maximum(p * (1 - p), 0) / n) + 10 / n + 1 / 256
    assert (np.abs(shown - p) < bound).all()


@pytest.mark.parametrize("sampler", ["sobol", "random", "jittered"])
@pytest.mark.parametrize(
    ("width", "velocity"), [(0.3, 0.7), (0.9, 0.4), (0.05, 1.2), (0.4, -0.8), (0.31, 40.0)]
)
def test_a_moving_bar_covers_a_trapezoid(
    make_scene: MakeScene, width: float, velocity: float, sampler: str
) -> None:
    first = -0.5 if abs(velocity) < 2 else -20.0
    first += 0.8 if velocity < 0 else 0.0
    scene = still(make_scene, bar(first, first + width, 0, velocity))
    p = average(lambda x, t: inside(x, first, first + width, velocity * t)[..., None])
    if abs(velocity) < 2:
        # The trapezoid in closed form, at the columns' middles, but for half a column's worth of its slope.
        x = (np.arange(SIZE) + 0.5) / (SIZE / 2) - 1
        s = (x - first) / velocity
        entered, left = np.clip(s, 0, 1), np.clip(s - width / velocity, 0, 1)
        assert np.abs(np.abs(entered - left) - p[:, 0]).max() <= 1 / 32 / abs(velocity) + 1e-2
    if velocity > 2:
        assert p.max() < 0.02
        shown = render(scene, sampler=sampler).linear[..., 0].mean(axis=0)
        n = SIZE * SAMPLES
        assert np.abs(shown - width / velocity).max() < 5 * math.sqrt(0.01 / n) + 10 / n
        return
    agree(scene, p, sampler)


def test_motion_in_depth_and_upwards(make_scene: MakeScene) -> None:
    # A bar that comes nearer: its edges wander outwards as 4 / (4 - z).
    scene = still(make_scene, bar(-0.4, 0.3, -2, [0, 0, 4.0]))
    agree(scene, average(lambda x, t: inside(x * (6 - 4 * t) / 4, -0.4, 0.3)[..., None]))
    # Turned by 90 degrees, columns become rows.
    turned = bar(-0.4, 0.3, 0)
    turned["transform"].append({"rotate": {"axis": [0, 0, 1], "degrees": 90}})
    up = still(make_scene, turned | {"motion": {"velocity": [0, 0.5, 0]}})
    p = average(lambda x, t: inside(x, -0.4, 0.3, 0.5 * t)[..., None])[::-1, 0]
    shown = render(up).linear[..., 0].mean(axis=1)
    n = SIZE * SAMPLES
    assert (np.abs(shown - p) < 5 * np.sqrt(p * (1 - p) / n) + 10 / n + 1 / 256).all()


def test_several_movers_and_still_things_before_and_behind_each_other(
    make_scene: MakeScene,
) -> None:
    # From the camera: a still green bar, a red one that goes right, a blue one that goes left, a still white one,
    # and another green one far behind that goes left.
    scene = still(
        make_scene,
        bar(-0.2, 0.1, 1, 0, "green"),
        bar(-0.9, -0.3, 0.5, 0.8, "red"),
        bar(0.1, 0.8, 0, -0.6, "blue"),
        bar(-0.5, 0.3, -0.5, 0.0, "white"),
        bar(0.5, 1.4, -0.7, -1.1, "green"),
    )

    def colour(x: Array, t: Array) -> Array:
        # A ray through x at z = 0 is at x (4 - z) / 4 at another z.
        out = np.zeros((*np.broadcast_shapes(x.shape, t.shape), 3))
        for z, x0, x1, v, rgb in (
            (-0.7, 0.5, 1.4, -1.1, [0, 1, 0]),
            (-0.5, -0.5, 0.3, 0.0, [1, 1, 1]),
            (0, 0.1, 0.8, -0.6, [0, 0, 1]),
            (0.5, -0.9, -0.3, 0.8, [1, 0, 0]),
            (1, -0.2, 0.1, 0.0, [0, 1, 0]),
        ):
            out[np.broadcast_to(inside(x * (4 - z) / 4, x0, x1, v * t), out.shape[:2])] = rgb
        return out

    p = average(colour)
    for sampler in ("sobol", "random"):
        agree(scene, p, sampler)


def test_movers_alike_share_a_hierarchy_and_equal_one_mesh(make_scene: MakeScene) -> None:
    scene = still(make_scene, bar(-0.8, -0.5, 0, 0.5), bar(-0.1, 0.2, 0, 0.5, "blue"))
    agree(
        scene,
        average(
            lambda x, t: np.stack(
                (inside(x, -0.8, -0.5, 0.5 * t), 0 * x * t, inside(x, -0.1, 0.2, 0.5 * t)), axis=-1
            )
        ),
    )


SUN = {"type": "directional", "direction": [3, 0, -1], "irradiance": math.pi * math.sqrt(10)}
"""Shifts shadows by 3 for each unit of height; a white wall in it has radiance 1."""


def test_the_shadow_of_a_moving_bar_is_a_trapezoid(make_scene: MakeScene) -> None:
    wall = bar(-20, 20, 0, 0, "matt")
    scene = still(make_scene, wall, bar(-3.5, -3.1, 1, 0.8, "black"), lights=[SUN])
    p = average(lambda x, t: 1.0 - inside(x, -0.5, -0.1, 0.8 * t)[..., None])
    for sampler in ("sobol", "random"):
        agree(scene, p, sampler)


def test_shadows_are_cast_at_the_time_of_the_camera_ray(make_scene: MakeScene) -> None:
    # A plate and its shade move alike, far apart: the plate is never lit. With times of their own, its ends would be.
    plate = bar(-0.6, 0.0, 0, 0.7, "matt")
    shade = bar(-0.65 - 3, 0.05 - 3, 1, 0.7, "black")
    dark = still(make_scene, plate, shade, lights=[SUN])
    assert not render(dark).linear.any()
    # And the other way round, in full: the shade runs away so that its shadow never meets the plate.
    free = still(make_scene, plate, bar(-2.9, -2.3, 1, 0.7, "black"), lights=[SUN])
    agree(free, average(lambda x, t: inside(x, -0.6, 0.0, 0.7 * t)[..., None]))


def test_a_mover_is_seen_in_a_mirror(make_scene: MakeScene) -> None:
    # A mirror at z = 0 shows what is at z = 8, behind the camera, as if at z = -8, where the picture is three times
    # as wide.
    scene = still(
        make_scene, bar(-20, 20, 0, 0, "mirror"), bar(-1.5, -0.6, 8, 2.1), materials=MATERIALS
    )
    p = average(lambda x, t: inside(3 * x, -1.5, -0.6, 2.1 * t)[..., None])
    for sampler in ("sobol", "random"):
        agree(scene, p, sampler)


def test_reflections_are_of_the_time_of_the_camera_ray(make_scene: MakeScene) -> None:
    # A mirror moves as its picture does: 3 times as far at three times the distance. At every moment it shows the whole
    # red bar and nothing else of the row, green to both sides, which a mirror at another time would show.
    mirror = bar(-0.7, -0.3, 0, 0.6, "mirror")
    row = [
        bar(-2.15, -0.85, 8, 1.8, "red"),
        bar(-9, -2.15, 8, 1.8, "green"),
        bar(-0.85, 9, 8, 1.8, "green"),
    ]
    scene = still(make_scene, mirror, *row)
    assert not render(scene).linear[..., 1].any()
    agree(scene, average(lambda x, t: inside(x, -0.7, -0.3, 0.6 * t)[..., None]))


@pytest.mark.parametrize("glass", [False, True])
def test_glossy_and_refracted_rays_keep_their_time(make_scene: MakeScene, glass: bool) -> None:
    if glass:
        # A pane of glass that bends nothing, before a moving bar.
        clear = MATERIALS | {"pane": {"dielectric": {"refraction_index": 1}}}
        pane = bar(-20, 20, 1, 0, "pane")
        scene = still(make_scene, pane, bar(-0.5, -0.2, 0, 0.7), materials=clear)
        agree(scene, average(lambda x, t: inside(x, -0.5, -0.2, 0.7 * t)[..., None]))
        return
    gloss = {"lobe": "plane", "roughness": 1e-4}
    blurred = MATERIALS | {"mirror": {"mirror": 1, "gloss": gloss}}
    scene = still(
        make_scene,
        bar(-0.7, -0.3, 0, 0.6, "mirror"),
        bar(-2.15, -0.85, 8, 1.8, "red"),
        bar(-9, -2.15, 8, 1.8, "green"),
        materials=blurred,
    )
    assert not render(scene).linear[..., 1].any()


def floor_mean(positions: Array, intensity: float, points: Array) -> Array:
    """Radiance of a white wall (normal +z, points (N, 3)) by a light at positions (M, 3), each 1 / M of the time."""
    to_light = positions[None] - points[:, None]
    d = np.linalg.norm(to_light, axis=-1)
    return np.asarray((intensity * to_light[..., 2] / d**3).mean(axis=1) / np.pi)


@pytest.mark.parametrize("kind", ["point", "sphere", "rectangle", "grid", "facing disk"])
def test_a_moving_light_lights_by_the_mean_of_its_places(make_scene: MakeScene, kind: str) -> None:
    # Small lights, so that their shape counts less than 1e-3.
    start, velocity = np.array([-1.0, 0.2, 1.0]), np.array([2.5, -0.4, 0.5])
    size = 0.02
    light: dict[str, Any] = {"intensity": 3, "motion": {"velocity": velocity.tolist()}}
    if kind == "point":
        light |= {"type": "point", "position": start.tolist()}
    elif kind in ("sphere", "facing disk"):
        light |= {"type": "sphere", "center": start.tolist(), "radius": size, "samples": kind}
    else:
        corner = (start - size / 2).tolist()
        light |= {"type": "rectangle", "corner": corner, "edge_u": [size, 0, 0]}
        light |= {"edge_v": [0, size, 0], "samples": "grid 2" if kind == "grid" else "point"}
    scene = still(make_scene, bar(-20, 20, 0, 0, "matt"), lights=[light])
    shown = render(scene, spp=256).linear[..., 0].astype(np.float64)
    t = (np.arange(400) + 0.5) / 400
    positions = start + velocity * t[:, None]
    centre = (np.arange(SIZE) + 0.5) / (SIZE / 2) - 1
    x, y = np.meshgrid(centre, -centre)
    points = np.stack((x.ravel(), y.ravel(), 0 * x.ravel()), axis=1)
    exact = floor_mean(positions, 3, points).reshape(SIZE, SIZE)
    # The deviation over time is about half of the value; 256 samples, 6 deviations (2e-9 for each of the 1024 pixels).
    assert (np.abs(shown - exact) < 6 * 0.5 * exact.max() / 16).all()
    assert abs(shown.mean() / exact.mean() - 1) < 6 * 0.5 / math.sqrt(256 * 1024) + 5e-3
    # The mean of 1024 absolute errors is at most one deviation, and hardly varies.
    assert np.abs(shown - exact).mean() < 0.5 * exact.max() / 16
    frozen = floor_mean(start[None], 3, points).reshape(SIZE, SIZE)
    assert np.abs(frozen - exact).mean() > 2 * 0.5 * exact.max() / 16, "it matters that it moves"


@pytest.mark.parametrize("kind", ["rectangle", "sphere"])
def test_a_moving_visible_light_is_seen_where_it_is(make_scene: MakeScene, kind: str) -> None:
    light: dict[str, Any] = {"radiance": 1, "motion": {"velocity": [0.8, 0, 0]}}
    if kind == "rectangle":
        light |= {"type": "rectangle", "corner": [-0.6, -20, 0], "edge_u": [0.4, 0, 0]}
        scene = still(make_scene, lights=[light | {"edge_v": [0, 40, 0]}])
        agree(scene, average(lambda x, t: inside(x, -0.6, -0.2, 0.8 * t)[..., None]))
        return
    # Along the middle rows, the chord of a ball: its outline at z = 0 is wider than its radius by 1 / cos.
    light |= {"type": "sphere", "center": [-0.4, 0, 0], "radius": 0.2}
    shown = render(still(make_scene, lights=[light])).linear[..., 0].astype(np.float64)
    assert abs(shown.sum() / 16**2 / (math.pi * 0.2**2) - 1) < 0.02
    # Its centre moves from -0.4 to 0.4, so the picture's middle is that of the streak, but for perspective at its ends.
    x = (np.arange(SIZE) + 0.5) / 16 - 1
    assert abs((shown.sum(axis=0) * x).sum() / shown.sum()) < 0.02


def test_a_moving_light_does_not_shadow_itself(make_scene: MakeScene) -> None:
    # Lit by a moving emitter as by the mean of emitters at rest, at 64 times.
    lamp = {"type": "rectangle", "corner": [-0.9, -0.3, 1.4], "edge_u": [0, 0.6, 0]} | {
        "edge_v": [0.6, 0, 0],
        "radiance": 4,
    }
    wall = bar(-20, 20, 0, 0, "matt")
    far = {"camera": {"eye": [0, 0, 1.2], "vertical_fov": 80}}
    moving = still(make_scene, wall, lights=[lamp | {"motion": {"velocity": [1.2, 0, 0]}}], **far)
    shown = render(moving, spp=256).linear[..., 0].astype(np.float64)
    stills = [
        render(
            still(make_scene, wall, lights=[lamp | {"corner": [1.2 * t - 0.9, -0.3, 1.4]}], **far)
        )
        for t in (np.arange(32) + 0.5) / 32
    ]
    exact = np.mean([picture.linear[..., 0] for picture in stills], axis=0)
    # Deviations below the value itself, 256 and 32 x 64 samples: 6 of them.
    assert (np.abs(shown - exact) < 6 * exact.max() / 16 * math.sqrt(1 + 1 / 8)).all()
    assert abs(shown.mean() / exact.mean() - 1) < 6 / math.sqrt(256 * 1024) + 5e-3


def rich(make_scene: MakeScene, objects: Any, camera: Any, lights: Any, shutter: Any) -> Scene:
    """A scene with shadows, a mirror and every kind of light, each with the given velocity."""

    def moves(v: list[float]) -> dict[str, Any]:
        return {"motion": {"velocity": v}}

    return make_scene(
        camera={"eye": [0.3, 1.4, 4], "look_at": [0, 0.4, 0]}
        | moves(camera)
        | {"shutter": shutter},
        film={"width": 40, "height": 30},
        sampler={"type": "sobol", "samples": 16},
        environment={"type": "constant", "radiance": [0.1, 0.2, 0.3]},
        materials={"grey": {"specular": 0.2}, "mirror": {"mirror": 0.8, "color": 0.1}},
        objects=[
            {"shape": "quad", "material": "grey", "width": 6, "depth": 6} | moves(objects),
            {"shape": "sphere", "material": "grey", "radius": 0.5}
            | {"transform": [{"translate": [-0.7, 0.63, 0.2]}]}
            | moves(objects),
            {"shape": "box", "material": "mirror"}
            | {"transform": [{"translate": [0.8, 0.541, -0.4]}]}
            | moves(objects),
            # Out of everyone's sight, so that all these scenes draw a time and their other numbers are the same.
            {"shape": "box", "material": "grey", "size": [0.01, 0.01, 0.01]}
            | {"transform": [{"translate": [0, -1, 0]}]}
            | moves([0.01, 0.02, 0.01]),
        ],
        lights=[
            {"type": "point", "position": [1, 3, 2], "intensity": 9} | moves(lights),
            {"type": "directional", "direction": [0.2, -1, -0.3], "irradiance": 0.5},
            {"type": "rectangle", "corner": [-2, 2.2, 0], "edge_u": [0.7, 0, 0]}
            | {"edge_v": [0, 0, 0.7], "radiance": 3}
            | moves(lights),
            {"type": "sphere", "center": [-0.2, 1.8, 1], "radius": 0.2, "intensity": 2}
            | moves(lights),
        ],
    )


def nearly_equal(a: Scene, b: Scene) -> None:
    """The same but for rounding: a few samples, 1 in 16 of a pixel, on the other side of an edge."""
    one, other = render(a).linear, render(b).linear
    different = np.abs(one - other).max(axis=2)
    assert (different > 2e-4).mean() < 0.01
    assert different.mean() < 2e-4
    assert one.std() > 0.1


V = [0.5, 0.2, -0.3]
BACK = [-0.5, -0.2, 0.3]
STILL = [0.0, 0.0, 0.0]


def test_a_moving_camera_is_everything_else_moving_the_other_way(make_scene: MakeScene) -> None:
    unit = {"open": 0, "close": 1}
    moved = rich(make_scene, STILL, V, STILL, unit)
    nearly_equal(moved, rich(make_scene, BACK, STILL, BACK, unit))
    # It isn't the same as standing still, nor as moving the same way.
    one = render(moved).linear
    for other in (STILL, V):
        scene = rich(make_scene, other, STILL, other, unit)
        assert np.abs(render(scene).linear - one).mean() > 5e-3


def test_what_moves_together_looks_still(make_scene: MakeScene) -> None:
    unit = {"open": 0, "close": 1}
    nearly_equal(rich(make_scene, V, V, V, unit), rich(make_scene, STILL, STILL, STILL, unit))


@pytest.mark.parametrize("far", [1e2, 1e5, 1e7])
def test_so_does_what_moves_together_by_many_of_its_sizes(
    make_scene: MakeScene, far: float
) -> None:
    """Float32 has no digits for both. What stays behind is out of sight at once."""
    velocity = {"motion": {"velocity": [far, 0.3 * far, 0]}}
    lamp = {"type": "sphere", "center": [2, 2, 2], "radius": 0.3, "radiance": 3}
    still, moved = (
        render(
            make_scene(
                camera={"eye": [0, 0, 4], "look_at": [0, 0, 0]}
                | {"shutter": {"open": 1, "close": 2}}
                | motion,
                objects=[{"shape": "sphere", "material": "grey"} | motion],
                lights=[lamp | motion],
            )
        ).linear
        for motion in (dict[str, Any](), velocity)
    )
    np.testing.assert_allclose(moved, still, atol=1e-4)
    assert still.max() > 0.03


def test_a_ball_that_flies_by_many_of_its_sizes_is_told(make_scene: MakeScene) -> None:
    ball = {"shape": "sphere", "material": "grey", "motion": {"velocity": [1e5, 0, 0]}}
    camera = {"eye": [0, 0, 4], "look_at": [0, 0, 0], "shutter": {"open": 0, "close": 1}}
    with pytest.warns(CourseWarning, match=r"objects\[0\] \(sphere\) of a width of 2 is too"):
        make_scene(camera=camera, objects=[ball])


def test_a_shutter_that_opens_later_sees_things_where_they_are_by_then(
    make_scene: MakeScene,
) -> None:
    late = {"open": 10, "close": 10.5}
    v = 0.8
    scene = still(make_scene, bar(-8.4, -8.0, 0, v), camera={"shutter": late})
    agree(scene, average(lambda x, t: inside(x, -8.4, -8.0, v * t)[..., None], 10, 10.5))
    early = still(make_scene, bar(-0.4, 0.0, 0, v), camera={"shutter": {"open": 0, "close": 0.5}})
    nearly = np.abs(render(scene).linear - render(early).linear)
    assert (nearly > 1e-5).any(axis=2).mean() < 0.01
    # Before time 0, too.
    before = still(make_scene, bar(0.6, 1.0, 0, v), camera={"shutter": {"open": -1, "close": -0.5}})
    agree(before, average(lambda x, t: inside(x, 0.6, 1.0, v * t)[..., None], -1, -0.5))


def test_a_late_shutter_moves_lights_and_camera_too(make_scene: MakeScene) -> None:
    # From 10 to 10.5 everything has gone 10 V together, and then goes on.
    late, early = {"open": 10, "close": 10.5}, {"open": 0, "close": 0.5}
    nearly_equal(rich(make_scene, V, V, V, late), rich(make_scene, V, V, V, early))
    nearly_equal(rich(make_scene, V, V, V, late), rich(make_scene, STILL, STILL, STILL, early))
