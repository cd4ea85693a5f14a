"""Fog against closed forms and quadrature: what gets through, what is scattered, and what is refused.

Numbers that chance decides are within 5.33 of their standard errors, with independent pixels: a false-fail rate of 1e-7
for each of about 50 numbers, 5e-6 for the file.
"""

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import render
from course.base.errors import CourseWarning, SceneError
from course.engine.radiosity.accepting import check_accepted
from course.engine.recording.recording import record
from course.engine.scene.darkness import why_dark
from tests.conftest import MakeScene
from tests.engine.terms.lights.over_a_floor import assert_mean
from tests.lengths import fewer
from tests.processes import python

AHEAD = {"eye": [0, 0, 3], "look_at": [0, 0, 0], "vertical_fov": 0.01}
CUBE = [[-1, -1, -1], [1, 1, 1]]
ONE = {"type": "random", "samples": 256}
BRIGHT = {"m": {"color": 0, "emission": 1}}
SCREEN = {
    "shape": "quad",
    "material": "m",
    "width": 20,
    "depth": 20,
    "transform": [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}, {"translate": [0, 0, -2]}],
}
"""A wall behind the fog that faces the eye."""

SIGMA = np.array([0.7, 1.1, 1.9])

both = pytest.mark.parametrize("kind", ["distribution", "path"])


def fog(**more: Any) -> dict[str, Any]:
    return {"extinction": SIGMA.tolist(), "box": CUBE} | more


def kinds(kind: str, **more: Any) -> dict[str, Any]:
    return {"type": kind, "max_depth": 0} | more


def grid(tmp_path: Path, values: Any) -> str:
    np.save(tmp_path / "grid.npy", np.asarray(values))
    return "grid.npy"


@both
def test_a_slab_lets_through_what_it_should(make_scene: MakeScene, kind: str) -> None:
    scene = make_scene(
        camera=AHEAD,
        materials=BRIGHT,
        objects=[SCREEN],
        media=[fog(albedo=0)],
        sampler=ONE,
        integrator=kinds(kind),
    )
    assert_mean(render(scene), np.exp(-2 * SIGMA))


@both
@pytest.mark.parametrize("aside", [0.0, 0.7, 1.1])
def test_a_ball_lets_through_what_its_chord_says(
    make_scene: MakeScene, kind: str, aside: float
) -> None:
    """Of a ball that is passed at a distance h from its middle a ray goes through 2 sqrt(r^2 - h^2)."""
    medium = {"extinction": SIGMA.tolist(), "albedo": 0}
    scene = make_scene(
        camera=AHEAD,
        materials=BRIGHT,
        objects=[SCREEN],
        media=[medium | {"sphere": {"center": [aside, 0, 0], "radius": 1}}],
        sampler=ONE,
        integrator=kinds(kind),
    )
    assert_mean(render(scene), np.exp(-2 * SIGMA * np.sqrt(max(1 - aside**2, 0))), 1e-5)


@both
def test_a_camera_in_a_ball_of_fog(make_scene: MakeScene, kind: str) -> None:
    """The eye is half a unit before its middle, and another ball touches it from behind."""
    medium = {"extinction": SIGMA.tolist(), "albedo": 0}
    scene = make_scene(
        camera=AHEAD,
        materials=BRIGHT,
        objects=[SCREEN],
        media=[
            medium | {"sphere": {"center": [0, 0, 2.5], "radius": 1}},
            medium | {"sphere": {"center": [0, 0, 0.5], "radius": 1}},
        ],
        sampler=ONE,
        integrator=kinds(kind),
    )
    assert_mean(render(scene), np.exp(-3.5 * SIGMA), 1e-5)


@both
def test_boxes_one_behind_the_other_and_a_camera_in_fog(make_scene: MakeScene, kind: str) -> None:
    """The eye stands in the middle of the first box."""
    near = fog(albedo=0, box=[[-1, -1, 1], [1, 1, 5]])
    far = fog(albedo=0, extinction=0.4, box=[[-1, -1, -1], [1, 1, 1]])
    scene = make_scene(
        camera=AHEAD,
        materials=BRIGHT,
        objects=[SCREEN],
        media=[far, near],
        sampler=ONE,
        integrator=kinds(kind),
    )
    assert_mean(render(scene), np.exp(-2 * SIGMA - 0.8))


@both
def test_fog_without_an_end(make_scene: MakeScene, kind: str) -> None:
    scene = make_scene(
        camera=AHEAD,
        materials=BRIGHT,
        objects=[SCREEN],
        media=[fog(albedo=0, extinction=0.3, box=None)],
        sampler=ONE,
        integrator=kinds(kind),
    )
    assert_mean(render(scene), np.exp(-0.3 * 5))


@fewer
@pytest.mark.parametrize("g", [-0.9, 0, 0.8])
@pytest.mark.parametrize("uneven", ["", "noise", "grid"])
def test_fog_that_absorbs_nothing_is_invisible_in_even_light(
    make_scene: MakeScene, tmp_path: Path, g: float, uneven: str
) -> None:
    """The furnace: each path brings 1, so there is no noise."""
    file = grid(tmp_path, np.random.default_rng(0).random((3, 4, 5)))
    more = {"noise": {"noise": {"scale": 2, "clear": 0.3}}, "grid": {"grid": file}, "": {}}
    scene = make_scene(
        camera=AHEAD | {"vertical_fov": 30},
        environment={"type": "constant", "radiance": 1, "lights": True},
        media=[fog(extinction=3, g=g, **more[uneven])],
        sampler=ONE | {"samples": 16},
        integrator={"type": "path", "max_depth": 1000, "roulette": None},
    )
    np.testing.assert_allclose(render(scene).linear, 1, atol=2e-5)


@pytest.mark.parametrize("where", ["ball", "in glass", "around glass", "partly in glass"])
def test_a_ball_of_fog_is_invisible_in_even_light(make_scene: MakeScene, where: str) -> None:
    """The furnace again, by itself and with clear glass, which mirrors and lets through what comes."""
    ball = {"center": [0, 0, 0], "radius": 0.8}
    glass = {"shape": "sphere", "material": "m", "segments": 32}
    size = {"in glass": 0.85, "around glass": 0.4, "partly in glass": 0.6}.get(where)
    if where == "partly in glass":
        ball = ball | {"center": [0.5, 0.2, 0]}
    known: dict[str, Any] = {
        "camera": AHEAD | {"vertical_fov": 30},
        "environment": {"type": "constant", "radiance": 1, "lights": True},
        "media": [{"extinction": 3, "g": 0.4, "sphere": ball}],
        "materials": {"m": {"color": 0, "dielectric": {}}},
        "sampler": ONE | {"samples": 4},
        "integrator": {"type": "path", "max_depth": 1000, "roulette": None},
    }
    if size is None:
        scene = make_scene(**known)
    else:
        with pytest.warns(CourseWarning, match="in the glass as well"):
            scene = make_scene(**known, objects=[glass | {"radius": size}])
    np.testing.assert_allclose(render(scene).linear, 1, atol=1e-3)


def quadrature(of_light: Any, albedo: float, g: float) -> np.ndarray:
    """Radiance of single scattering along the ray from (0, 0, 1) to (0, 0, -1) in the cube, (3,).

    ``of_light``: (points (3, n)) -> irradiance (n,) at right angles, unit vectors to the light (3, n), and how far it
    comes through the cube (n,)
    """
    n = 100_000
    z = 1 - 2 * (np.arange(n) + 0.5) / n
    irradiance, toward, inside = of_light(np.stack((0 * z, 0 * z, z)))
    # The eye's ray goes along -z; light goes against `toward`, and then along +z.
    cos = -toward[2]
    phase = (1 - g * g) / (4 * np.pi * (1 + g * g - 2 * g * cos) ** 1.5)
    left = np.exp(-SIGMA[:, None] * (1 - z + inside))
    return 2 * albedo * SIGMA * (left * phase * irradiance).mean(axis=1)


PLACE = np.array([0.3, 0.8, 0.2])


def of_point(points: np.ndarray) -> tuple[Any, ...]:
    way = PLACE[:, None] - points
    distance = np.linalg.norm(way, axis=0)
    return 5 / distance**2, way / distance, distance


SUN = np.array([0.0, 0.6, 0.8])


def of_sun(points: np.ndarray) -> tuple[Any, ...]:
    inside = np.minimum(1 / SUN[1], (1 - points[2]) / SUN[2])
    return np.full(points.shape[1], 2.0), np.repeat(SUN[:, None], points.shape[1], 1), inside


LAMPS = {
    "point": ({"type": "point", "position": PLACE.tolist(), "intensity": 5}, of_point),
    "sun": ({"type": "directional", "direction": (-SUN).tolist(), "irradiance": 2}, of_sun),
}


@fewer
@both
@pytest.mark.parametrize("lamp", LAMPS)
@pytest.mark.parametrize("g", [0.4, -0.6])
def test_light_that_is_scattered_once(
    make_scene: MakeScene, kind: str, lamp: str, g: float
) -> None:
    light, arriving = LAMPS[lamp]
    scene = make_scene(
        camera=AHEAD,
        lights=[light],
        media=[fog(albedo=0.8, g=g)],
        sampler=ONE,
        integrator=kinds(kind),
    )
    assert_mean(render(scene), quadrature(arriving, 0.8, g), 3e-4)


@both
def test_one_of_two_lamps_that_is_chosen_stands_for_both(make_scene: MakeScene, kind: str) -> None:
    scene = make_scene(
        camera=AHEAD,
        lights=[light for light, _ in LAMPS.values()],
        media=[fog(albedo=0.8)],
        sampler=ONE,
        integrator=kinds(kind, light_sampling="uniform"),
    )
    assert_mean(render(scene), quadrature(of_point, 0.8, 0) + quadrature(of_sun, 0.8, 0), 3e-4)


@both
def test_surfaces_get_light_through_fog(make_scene: MakeScene, kind: str) -> None:
    """Absorbing fog before a wall that a lamp beside the eye lights: both ways count, and each channel by itself."""
    wall = SCREEN | {"material": "w"}
    scene = make_scene(
        camera=AHEAD,
        materials={"w": {"color": 0.5}},
        objects=[wall],
        lights=[{"type": "point", "position": [0, 0, 2], "intensity": 10}],
        media=[fog(albedo=0)],
        sampler=ONE,
        integrator=kinds(kind),
    )
    assert_mean(render(scene), 0.5 / np.pi * 10 / 16 * np.exp(-4 * SIGMA))


@both
def test_surfaces_see_the_sky_through_fog(make_scene: MakeScene, kind: str) -> None:
    """A floor in the middle of an absorbing layer: exp(-sigma h / cos), weighted by the cosine."""
    cos = (np.arange(200_000) + 0.5) / 200_000
    through = np.array([(2 * cos * np.exp(-s / cos)).mean() for s in SIGMA])
    floor = {"shape": "quad", "material": "w", "width": 100, "depth": 100}
    scene = make_scene(
        camera={"eye": [0, 1, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 0.01},
        materials={"w": {"color": 0.5}},
        objects=[floor],
        environment={"type": "constant", "radiance": 2, "lights": True},
        media=[fog(albedo=0, box=[[-50, -1, -50], [50, 1, 50]])],
        sampler=ONE,
        integrator=kinds(kind),
    )
    assert_mean(render(scene), 0.5 * 2 * through * np.exp(-SIGMA), 1e-3)


@both
def test_an_uneven_slab_lets_through_what_its_integral_says(
    make_scene: MakeScene, tmp_path: Path, kind: str
) -> None:
    """Densities along z that differ from cell to cell: trilinear between middles, even beyond the outermost."""
    values = np.array([0.2, 1.5, 0.0, 0.9])
    along = np.interp((np.arange(4000) + 0.5) / 1000 - 0.5, np.arange(4), values)
    file = grid(tmp_path, np.broadcast_to(values, (2, 3, 4)))
    scene = make_scene(
        camera=AHEAD,
        materials=BRIGHT,
        objects=[SCREEN],
        media=[fog(albedo=0, extinction=1.4, grid=file)],
        sampler=ONE,
        integrator=kinds(kind),
    )
    assert_mean(render(scene), np.exp(-2 * 1.4 * along.mean()))


@both
def test_a_grid_of_one_density_is_even_fog(
    make_scene: MakeScene, tmp_path: Path, kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys.modules[__name__], "SIGMA", np.array([1.2, 1.2, 1.2]))
    scene = make_scene(
        camera=AHEAD,
        lights=[LAMPS["point"][0]],
        media=[fog(albedo=0.8, g=0.3, extinction=0.6, grid=grid(tmp_path, np.full((2, 2, 2), 2)))],
        sampler=ONE,
        integrator=kinds(kind),
    )
    assert_mean(render(scene), quadrature(of_point, 0.8, 0.3), 3e-4)


@both
def test_densities_of_a_million_and_of_nothing(make_scene: MakeScene, kind: str) -> None:
    for extinction, expected in ((1e6, 0.0), (0.0, 1.0)):
        scene = make_scene(
            camera=AHEAD,
            materials=BRIGHT,
            objects=[SCREEN],
            lights=[LAMPS["point"][0]],
            media=[fog(albedo=0, extinction=extinction)],
            integrator=kinds(kind),
        )
        np.testing.assert_allclose(render(scene).linear, expected, atol=1e-30)


BALL = {"extinction": 1, "sphere": {"center": [1.4, 1.4, 1.4], "radius": 0.9}}
"""It overlaps the cube at a corner, which is 0.4 sqrt(3) = 0.69 from its middle."""


def test_balls_may_touch_boxes_and_each_other(make_scene: MakeScene) -> None:
    """The corner (1, 1, 1) is 0.86 from the middle of the first ball, whose box reaches into it."""
    near = {"extinction": 1, "sphere": {"center": [1.5, 1.5, 1.5], "radius": 0.86}}
    other = {"extinction": 1, "sphere": {"center": [3.4, 1.5, 1.5], "radius": 1.04}}
    make_scene(media=[fog(), near, other])


@pytest.mark.parametrize(
    ("media", "says"),
    [
        ([fog(), fog()], r"media\[1\].*overlaps media\[0\]"),
        ([fog(), fog(box=None)], r"media\[1\].*overlaps media\[0\].*is alone"),
        ([fog(), BALL], r"media\[1\].*overlaps media\[0\]"),
        ([BALL, fog(box=None)], r"media\[1\].*overlaps media\[0\].*is alone"),
        ([BALL, BALL | {"sphere": {"center": [2.9, 2, 1.5], "radius": 1}}], r"overlaps media\[0\]"),
        ([fog() | BALL | {"box": CUBE}], r"media\[0\].*both box and sphere"),
        ([BALL | {"extinction": 1, "noise": {}}], r"media\[0\].noise.*box"),
        ([BALL | {"sphere": {"center": [0, 0, 0], "radius": 0}}], r"media\[0\].sphere.radius"),
        (
            [BALL | {"sphere": {"center": [9, 0, 0], "radius": 1e-5}}],
            r"media\[0\].sphere.*along x.*expected at least 0.0001",
        ),
        ([fog(albedo=1.01)], r"media\[0\].albedo"),
        ([fog(g=1)], r"media\[0\].g"),
        ([fog(g=-1)], r"media\[0\].g"),
        ([fog(extinction=-1)], r"media\[0\].extinction"),
        ([fog(box=[[0, 0, 0], [1, 0, 1]])], r"media\[0\].box.*room between"),
        (
            [fog(box=[[9, 0, 0], [9.00001, 1, 1]])],
            r"media\[0\].box.*along x.*expected at least 0.0001",
        ),
        ([fog(noise={})], r"media\[0\].extinction.*one number"),
        ([fog(extinction=1, noise={}, box=None)], r"media\[0\].noise.*box"),
        ([fog(extinction=1, noise={}, grid="grid.npy")], r"media\[0\].*both grid and noise"),
        ([fog(extinction=1, grid="none.npy")], r"media\[0\].grid.*none.npy.*no such file"),
        ([fog(extinction=1, grid="scene.yaml")], r"media\[0\].grid.*numpy.save"),
        ([fog(extinction=1, grid="flat.npy")], r"media\[0\].grid.*three axes"),
        ([fog(extinction=1, grid="nan.npy")], r"media\[0\].grid.*nan at index \(1, 0, 1\)"),
    ],
)
def test_what_is_refused(
    make_scene: MakeScene, tmp_path: Path, media: list[dict[str, Any]], says: str
) -> None:
    np.save(tmp_path / "flat.npy", np.ones((3, 3)))
    values = np.ones((2, 2, 2))
    values[1, 0, 1] = np.nan
    np.save(tmp_path / "nan.npy", values)
    with pytest.raises(SceneError, match=says):
        make_scene(media=media)


def test_glass_in_fog_is_told_and_refused_where_it_absorbs(make_scene: MakeScene) -> None:
    ball = {"shape": "sphere", "material": "m", "radius": 0.5}
    with pytest.warns(CourseWarning, match=r"objects\[0\].*in the glass as well"):
        make_scene(materials={"m": {"color": 0, "dielectric": {}}}, objects=[ball], media=[fog()])
    absorbs = {"m": {"color": 0, "dielectric": {"absorption": 1}}}
    with pytest.raises(SceneError, match=r"objects\[0\].*glass absorbs"):
        make_scene(materials=absorbs, objects=[ball], media=[fog()])


def test_light_from_far_away_that_fog_without_an_end_stops_is_told(make_scene: MakeScene) -> None:
    with pytest.warns(CourseWarning, match=r"media\[0\].*light 0 comes through"):
        make_scene(lights=[LAMPS["sun"][0]], media=[fog(box=None)])


def test_a_scene_without_fog_imports_nothing_of_it() -> None:
    code = (
        "import sys; from course import render; from course.engine.scene.scene import load_scene;"
        "render(load_scene('scenes/before/media.yaml'), size=(8, 6), spp=1);"
        "print([m for m in sys.modules if m.startswith('course.engine.terms.media')"
        " or m == 'course.engine.scene.building.further.media'])"
    )
    assert python("-c", code).stdout.strip() == "[]"


@both
def test_the_rays_of_a_pixel_tell_of_fog_and_add_up(make_scene: MakeScene, kind: str) -> None:
    """Radiance of segments is that of the pixel, and some of it comes from shadow rays that start between surfaces."""
    scene = make_scene(
        camera=AHEAD,
        film={"width": 3, "height": 2},
        materials={"w": {"color": 0.5}},
        objects=[SCREEN | {"material": "w"}],
        lights=[light for light, _ in LAMPS.values()],
        environment={"type": "constant", "radiance": 0.2, "lights": True},
        media=[fog(albedo=0.8)],
        sampler={"type": "sobol", "samples": 64},
        integrator=kinds(kind, max_depth=3),
    )
    recording = record(scene, 1, 1)
    picture = render(scene).linear[1, 1]
    total = sum(np.array(one.radiance) for one in recording.segments) / 64
    np.testing.assert_allclose(total, picture, rtol=1e-3)
    lit = [one for one in recording.segments if one.kind == "shadow" and abs(one.start[2]) < 1]
    assert lit
    assert any(one.met == "the fog" for one in recording.segments) == (kind == "path")


def test_fog_without_anything_that_is_lit_is_not_said_to_be_black(make_scene: MakeScene) -> None:
    lamp = LAMPS["point"][0]
    assert why_dark(make_scene(camera=AHEAD, lights=[lamp], media=[]))
    scene = make_scene(camera=AHEAD, lights=[lamp], media=[fog()])
    assert why_dark(scene) == ""
    assert render(scene).linear.min() > 0


def test_radiosity_refuses_fog(make_scene: MakeScene) -> None:
    with pytest.raises(SceneError, match=r"media.*expected none: radiosity"):
        check_accepted(make_scene(media=[fog()]).loaded)
