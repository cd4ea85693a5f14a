"""Photons against closed forms: the power of lamps, what glass and metal gather, and what is told or refused.

Means of independent passes are within 5.33 of their standard errors: a false-fail rate of 1e-7 for each of about 30
numbers. Photons of a pass are spread evenly, so that its own error is far below that of independent ones.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from course import render
from course.base.errors import CourseWarning, SceneError
from course.engine.core.types import Floats64
from course.engine.radiosity.accepting import check_accepted
from course.engine.terms.photons import passes
from tests.conftest import MakeScene
from tests.engine.terms.photons.parts import (
    FLOOR,
    GLASS,
    GLOBE,
    WHITE,
    ball,
    caustics,
    photons_of,
    pictures,
    sent,
)
from tests.processes import python

SQUARE = {"type": "rectangle", "corner": [-0.5, 3, -0.5], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1]}
PANEL = {
    "shape": "quad",
    "name": "panel",
    "material": "panel",
    "width": 0.8,
    "depth": 0.5,
    "transform": [{"translate": [0, 3, 0]}],
}
INNER, OUTER = np.cos(np.radians([20, 35]))

LAMPS = {
    "point": ({"type": "point", "position": [0, 3, 0], "intensity": 2}, 8 * np.pi),
    "spot": (
        {
            "type": "spot",
            "position": [0, 3, 0],
            "direction": [0, -1, 0],
            "intensity": 2,
            "inner_angle": 20,
            "outer_angle": 35,
        },
        # A fourth power between the cones leaves a fifth.
        4 * np.pi * (1 - INNER + (INNER - OUTER) / 5),
    ),
    "rectangle": (SQUARE | {"radiance": 3}, 3 * np.pi),
    "from both sides": (SQUARE | {"radiance": 3, "two_sided": True, "visible": False}, 6 * np.pi),
    "points over a rectangle": (SQUARE | {"intensity": 3}, 12 * np.pi),
    "grid": (SQUARE | {"intensity": 3, "samples": "grid 1"}, 12 * np.pi),
    "sphere": (
        {"type": "sphere", "center": [0, 3, 0], "radius": 0.2, "radiance": 3},
        3 * np.pi * 0.16 * np.pi,
    ),
    "visible sphere": (
        {"type": "sphere", "center": [0, 3, 0], "radius": 0.2, "radiance": 3, "samples": "visible"},
        3 * np.pi * 0.16 * np.pi,
    ),
    "points in a ball": (
        {"type": "sphere", "center": [0, 3, 0], "radius": 0.2, "intensity": 3, "samples": "ball"},
        12 * np.pi,
    ),
    "facing disk": (
        {
            "type": "sphere",
            "center": [0, 3, 0],
            "radius": 0.2,
            "intensity": 3,
            "samples": "facing disk",
        },
        12 * np.pi,
    ),
    "object": ({"type": "object", "object": "panel"}, 2 * np.pi * 1.5 * 0.4),
}


@pytest.mark.parametrize("name", LAMPS)
def test_all_photons_have_the_power_of_the_lamp(make_scene: MakeScene, name: str) -> None:
    lamp, power = LAMPS[name]
    materials = {"white": WHITE, "m": GLASS, "panel": {"color": 0, "emission": 1.5}}
    scene = caustics(make_scene, materials=materials, objects=[FLOOR, ball(), PANEL], lights=[lamp])
    origin, way, found = sent(scene)
    assert found.sum(axis=1) == pytest.approx(np.full(3, power), rel=0.02)
    assert np.linalg.norm(way, axis=0) == pytest.approx(np.ones(way.shape[1]), abs=1e-5)
    # All leave the lamp, or next to it.
    far = np.abs(origin - np.array([[0], [3], [0]])).max(axis=1)
    assert (far <= np.array([0.51, 0.21, 0.51])).all()


@pytest.mark.parametrize("name", ["point", "spot"])
def test_where_they_are_aimed_they_have_the_power_that_goes_there(
    make_scene: MakeScene, name: str
) -> None:
    scene = caustics(make_scene, lights=[LAMPS[name][0]])
    _, way, found = sent(scene, everywhere=False)
    edge = np.sqrt(1 - (0.3 / 2.2) ** 2)
    assert (-way[1] >= edge - 1e-3).all()
    assert found.sum(axis=1) == pytest.approx(np.full(3, 4 * np.pi * (1 - edge)), rel=0.01)


def test_a_mirror_sends_on_its_share_of_what_meets_it(make_scene: MakeScene) -> None:
    """A mirror ball over a floor without an end in sight: photons that come down again are those of its lower part.

    The lamp is in the middle of a closed box, so that all comes to a wall.
    """
    room = {"shape": "box", "material": "white", "size": [6, 6, 6]}
    lamp = {"type": "point", "position": [0, 2.5, 0], "intensity": [1, 2, 3]}
    mirror = {"color": 0, "mirror": [0.9, 0.5, 0.2]}
    scene = caustics(make_scene, mirror, objects=[room, ball(0.3, 0.0)], lights=[lamp])
    photons = photons_of(scene)
    edge = np.sqrt(1 - (0.3 / 2.5) ** 2)
    meets = 2 * np.pi * (1 - edge) * np.array([1, 2, 3])
    expected = meets * np.array([0.9, 0.5, 0.2])
    # 20,000 photons by chance: the largest share survives, others have less power.
    sigma = np.sqrt((1 - 0.9) / 0.9 / 20_000) * expected
    assert (np.abs(photons.power.sum(axis=1) - expected) <= 5.33 * sigma + 2e-3 * expected).all()


def fresnel(cos: Floats64, eta: float) -> Floats64:
    """Reflectance from air into glass of index eta."""
    out = np.sqrt(1 - (1 - cos**2) / eta**2)
    s = (cos - eta * out) / (cos + eta * out)
    p = (eta * cos - out) / (eta * cos + out)
    return np.asarray((s**2 + p**2) / 2)


@pytest.mark.parametrize("motion", [{}, {"motion": {"velocity": [0.5, 0, 0.2]}}])
def test_a_glass_ball_gathers_a_beam_as_its_rays_say(
    make_scene: MakeScene, motion: dict[str, Any]
) -> None:
    """Light straight down: a ray that meets the ball at b R leaves it at an angle of 2 (a - c), where sin a = b
    and sin c = b / 1.5, and comes to the floor at a radius in closed form. What moves with the floor stays on it.
    """
    beam = {"type": "directional", "direction": [0, -1, 0], "irradiance": 2}
    scene = caustics(
        make_scene,
        lights=[beam],
        objects=[FLOOR | motion, ball(**motion)],
        photons={"count": 50_000, "radius": 0.05},
    )
    passes = [photons_of(scene, number) for number in range(4)]
    radius, height = 0.3, 0.8
    b = np.sqrt((np.arange(200_000) + 0.5) / 200_000)
    into, within = np.arcsin(b), np.arcsin(b / 1.5)
    turn = 2 * (into - within)
    x = -radius * np.sin(turn - into)
    y = -radius * np.cos(turn - into)
    lands = np.where(turn < np.pi / 2, np.abs(x - (height + y) * np.tan(turn)), np.inf)
    share = (1 - fresnel(np.cos(into), 1.5)) ** 2
    power = 2 * np.pi * radius**2 * share / len(b)
    # Of single passes the part within 0.05 spreads by 2% over seeds, what is farther out by less.
    for bound in (0.05, 0.1, 0.15):
        expected = power[lands <= bound].sum()
        came = [p.power[0, np.hypot(*p.position[[0, 2]]) <= bound].sum() for p in passes]
        assert np.mean(came) == pytest.approx(expected, rel=0.05)


def test_a_caustic_follows_its_ball_while_the_shutter_is_open(make_scene: MakeScene) -> None:
    """Along a way of length 1 at an even speed: a quarter of its light lies in each quarter of the way."""
    camera = {"eye": [0, 5, 0.01], "look_at": [0, 0, 0], "shutter": {"open": 0, "close": 1}}
    scene = caustics(
        make_scene,
        camera=camera,
        lights=[{"type": "directional", "direction": [0, -1, 0], "irradiance": 2}],
        objects=[FLOOR, ball(motion={"velocity": [1, 0, 0]})],
    )
    photons = photons_of(scene)
    # What lands farther off has been mirrored in the ball.
    near = (np.abs(photons.position[2]) < 0.1) & (np.abs(photons.position[0] - 0.5) < 0.7)
    x, power = photons.position[0, near], photons.power[0, near].astype(np.float64)
    for quarter in (0.25, 0.5, 0.75):
        assert power[x < quarter].sum() / power.sum() == pytest.approx(quarter, abs=0.02)


RING = {
    "shape": "torus",
    "material": "m",
    "radius": 1.0,
    "tube": 0.001,
    "segments": 2048,
    "sides": 12,
    "transform": [{"scale": [1, 60, 1]}, {"translate": [0, 0.06, 0]}],
}
"""A low wall around the middle of the floor."""


def reflected_in_ring(make_scene: MakeScene, lamp: dict[str, Any]) -> tuple[Floats64, ...]:
    """Where on the ring photons have been mirrored [angle], their ways on the floor (2, n), and how far from the
    middle these pass.
    """
    mirror = {"color": 0, "mirror": 1}
    scene = caustics(
        make_scene, mirror, objects=[FLOOR, RING], lights=[lamp], integrator={"max_depth": 1}
    )
    photons = photons_of(scene)
    x, _, z = photons.position
    way = photons.direction[[0, 2]] / np.hypot(photons.direction[0], photons.direction[2])
    # Inside, and away from the lamp's side, which the lamp lights past the wall.
    inside = (np.hypot(x, z) < 0.99) & (np.hypot(x, z) > 0.01)
    x, z, way = x[inside], z[inside], way[:, inside]
    # Back along its way to the wall: the place of the reflection.
    b = x * way[0] + z * way[1]
    back = b + np.sqrt(b * b - (x * x + z * z - 1))
    place = np.arctan2(z - back * way[1], x - back * way[0])
    assert len(x) > 500
    return place, way, np.abs(x * way[1] - z * way[0])


def test_a_ring_of_metal_draws_a_nephroid(make_scene: MakeScene) -> None:
    """A low sun in a mirror ring: light that meets the wall at an angle phi is turned by 2 phi, and every ray touches
    the curve with points ((3 cos phi - cos 3 phi) / 4, (3 sin phi - sin 3 phi) / 4) of the ring's radius.
    """
    # So flat that what is reflected lands within the ring, half a radius from the wall at the height of the middle.
    sun = {"type": "directional", "direction": [1, -0.12, 0], "irradiance": 1}
    place, way, distance = reflected_in_ring(make_scene, sun)
    met = way[0] < -0.2
    place, way, distance = place[met], way[:, met], distance[met]
    turned = np.stack((-np.cos(2 * place), -np.sin(2 * place)))
    # A facet of 2048 is flat: its normal is off by half a 2048th of a turn, which turns light by 0.003. Those at the
    # wall's top and foot lean by a 16th, and so turn a sun of this slope by 2 x 0.12 / 16.
    assert np.abs(turned - way).max() < 0.02
    # Rays touch the nephroid: their distance from the middle is sin phi, that of its tangents.
    assert distance == pytest.approx(np.abs(np.sin(place)), abs=0.02)


def test_a_lamp_on_a_ring_of_metal_draws_a_cardioid(make_scene: MakeScene) -> None:
    """Light from the ring at an angle 0 that meets it at phi goes on to 2 phi: a chord that passes the middle at
    cos(phi / 2), and touches the cardioid with points (2 cos phi + cos 2 phi, 2 sin phi + sin 2 phi) / 3.
    """
    lamp = {"type": "point", "position": [0.997, 0.2, 0], "intensity": 1}
    place, way, distance = reflected_in_ring(make_scene, lamp)
    # Near the lamp a facet, and the lamp's own distance from the wall, turn much; the wall leans by a 60th.
    far = np.abs(place) > 0.5
    place, way, distance = place[far], way[:, far], distance[far]
    # From exp(i phi) to exp(2 i phi): at right angles to the chord's middle, by the shorter way round.
    onwards = np.sign(np.sin(place / 2))
    expected = onwards * np.stack((-np.sin(1.5 * place), np.cos(1.5 * place)))
    assert np.abs(expected - way).max() < 0.05
    assert distance == pytest.approx(np.abs(np.cos(place / 2)), abs=0.05)


def test_clear_glass_sends_on_all_that_meets_it(make_scene: MakeScene) -> None:
    """In a closed room all power that comes to the ball comes to a wall; 16 bounces within keep less than 1e-6.

    20,000 photons all live, and the numbers of those that leave are evenly spread.
    """
    room = {"shape": "box", "material": "white", "size": [6, 6, 6]}
    lamp = {"type": "point", "position": [0, 2.5, 0], "intensity": [1, 2, 3]}
    scene = caustics(
        make_scene, objects=[room, ball(0.3, 0.0)], lights=[lamp], integrator={"max_depth": 16}
    )
    found = photons_of(scene).power.sum(axis=1, dtype=np.float64)
    meets = 2 * np.pi * (1 - np.sqrt(1 - (0.3 / 2.5) ** 2)) * np.array([1, 2, 3])
    # A ball of 256 segments is smaller than a round one.
    assert found == pytest.approx(meets, rel=1e-3)


SKY = {"type": "lat_long", "image": "sky.png", "lights": True, "scale": 4}


@pytest.mark.parametrize(
    ("material", "light"),
    [
        (GLASS, {"lights": [GLOBE]}),
        ({"color": 0.2, "mirror": 0.5}, {"lights": [GLOBE]}),
        (GLASS, {"lights": [], "environment": SKY}),
    ],
    ids=["glass", "half", "sky"],
)
def test_paths_and_photons_agree(
    make_scene: MakeScene, tmp_path: Path, material: dict[str, Any], light: dict[str, Any]
) -> None:
    """A floor under a ball, by paths that meet the lamp by chance, and by paths that leave this to photons."""
    # Brighter at one side.
    sky = np.full((8, 16, 3), 120, np.uint8)
    sky[1:3, 4:7] = 255
    Image.fromarray(sky).save(tmp_path / "sky.png")
    parts: dict[str, Any] = {
        "camera": {"eye": [0, 0.45, 0], "look_at": [0, 0, 0.01], "vertical_fov": 120},
        "film": {"width": 8, "height": 8},
        "integrator": {"type": "path", "max_depth": 6},
        **light,
    }
    truth = caustics(make_scene, material, photons=None, **parts)
    by_paths = pictures(truth, 256, 4)
    found = caustics(make_scene, material, photons={"count": 10_000, "radius": 0.02}, **parts)
    by_photons = pictures(found, 32, 4)
    error = np.hypot(by_paths.std(axis=0, ddof=1), by_photons.std(axis=0, ddof=1)) / 2
    # Three degrees of freedom: 6 standard errors for 1e-2 of each; a few thousandths are blurred out of the picture.
    off = np.abs(by_paths.mean(axis=0) - by_photons.mean(axis=0))
    assert (off <= 6 * error + 0.004 * by_paths.mean(axis=0)).all()


def test_a_scene_without_photons_imports_none() -> None:
    code = (
        "import sys; from course import load_scene, render;"
        "render(load_scene('scenes/path_tracing.yaml'), spp=1, size=(8, 6));"
        "print([n for n in sys.modules if 'terms.photons' in n or 'further.photons' in n or 'spatial' in n])"
    )
    assert python("-c", code).stdout.strip() == "[]"


def test_a_scene_without_photons_draws_no_number_and_sends_no_ray_for_them(
    make_scene: MakeScene,
) -> None:
    parts: dict[str, Any] = {"lights": [GLOBE], "film": {"width": 8, "height": 8}}
    receipt = render(caustics(make_scene, photons=None, **parts), spp=4).receipt
    drawn = {*receipt.numbers, *receipt.rays}
    assert not [name for name in drawn if "photon" in name or "gather" in name or "fog" in name]


def test_photons_are_the_same_however_the_picture_is_rendered(make_scene: MakeScene) -> None:
    scene = caustics(make_scene, lights=[GLOBE], film={"width": 24, "height": 20})
    one, other = (render(scene, spp=32, threads=n).linear for n in (1, 2))
    assert np.array_equal(one, other)
    assert not np.array_equal(one, render(scene, spp=32, seed=5).linear)


@pytest.mark.parametrize(
    ("parts", "said"),
    [
        ({"objects": [FLOOR]}, "nothing mirrors or refracts"),
        ({"lights": []}, "no light sends any"),
        ({"integrator": {"max_depth": 0}}, "no surface sends light on.*max_depth is 0"),
        ({"materials": {"white": {"color": 0, "mirror": 1}, "m": GLASS}}, "nothing is matte"),
        ({"photons": {"count": 100_000_000}}, "take about 3 minutes a pass; at most 1,048,576"),
        ({"photons": {"count": 20_000_000}}, "take about 40 seconds a pass; at most 1,048,576"),
        (
            {
                "environment": {"type": "constant", "radiance": 1},
                "integrator": {"type": "path"},
            },
            "no photons leave an environment that lights no surface.*set environment.lights",
        ),
    ],
)
def test_what_makes_no_caustic_or_takes_long_is_told(
    make_scene: MakeScene, parts: dict[str, Any], said: str
) -> None:
    with pytest.warns(CourseWarning, match=said):
        caustics(make_scene, **{"lights": [GLOBE]} | parts)


def test_photons_in_fog_are_refused(make_scene: MakeScene) -> None:
    with pytest.raises(SceneError, match=r"photons: expected null in a scene with media"):
        caustics(
            make_scene,
            {"color": 0, "mirror": 1},
            lights=[GLOBE],
            media=[{"extinction": 1, "box": [[-1, 0, -1], [1, 1, 1]]}],
        )


def test_radiosity_refuses_photons(make_scene: MakeScene) -> None:
    scene = caustics(make_scene, {"color": 0, "mirror": 1}, lights=[GLOBE])
    with pytest.raises(SceneError, match=r"photons.*none: radiosity knows light from matte"):
        check_accepted(scene.loaded)


def test_photons_without_a_way_to_the_floor_are_told(make_scene: MakeScene) -> None:
    """The ball is in a closed box: none comes to it."""
    box = {
        "shape": "box",
        "material": "white",
        "size": [1, 1, 1],
        "transform": [{"translate": [0, 0.8, 0]}],
    }
    scene = caustics(
        make_scene, lights=[GLOBE], objects=[FLOOR, ball(), box], film={"width": 8, "height": 8}
    )
    with pytest.warns(CourseWarning, match=r"none of 20,000 photons has come to a matte surface"):
        lit = render(scene, spp=1).linear
    dark = caustics(
        make_scene,
        lights=[GLOBE],
        objects=[FLOOR, ball(), box],
        film={"width": 8, "height": 8},
        photons=None,
    )
    assert np.array_equal(lit, render(dark, spp=1).linear)


def test_what_is_kept_of_a_pass_is_bounded(
    make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where too many would be kept no more are sent, and those that were stand for all."""
    monkeypatch.setattr(passes, "BATCH", 4096)
    scene = caustics(make_scene, lights=[LAMPS["point"][0]], photons={"count": 50_000})
    whole = photons_of(scene)
    monkeypatch.setattr(passes, "MOST", 10_000)
    some = photons_of(caustics(make_scene, lights=[LAMPS["point"][0]], photons={"count": 50_000}))
    assert some.count < 16_000 < whole.count
    assert some.power.sum() == pytest.approx(whole.power.sum(), rel=0.02)
