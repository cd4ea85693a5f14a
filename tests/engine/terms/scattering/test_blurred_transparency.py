"""Frosted glass through the engine: nothing is lost, the cone is as wide as its formula, and clear glass stays clear.

Means are compared as in tests/estimates.py, 18 of them.
"""

import math
from typing import Any

import numpy as np
import pytest

from course import Picture, Scene, render
from course.engine.functions.modules import COURSE
from tests.conftest import MakeScene
from tests.drawn import numbers_drawn, rows
from tests.estimates import estimate, fresnel
from tests.forms import in_both_forms
from tests.lengths import fewer

MODULE = "blurred_transparency"
FUNCTIONS = {f"{MODULE}.{name}" for name in COURSE[MODULE]}
TRACERS = ["distribution", "path"]
INDEX = 1.5
PLATE = {"shape": "quad", "material": "glass", "width": 200, "depth": 200}
WHITE = {"type": "constant", "radiance": 1}


def glass(roughness: float | None, index: float = INDEX, **more: Any) -> dict[str, Any]:
    dielectric = {"refraction_index": index}
    if roughness is not None:
        dielectric["roughness"] = roughness
    return {"glass": {"color": 0, "dielectric": dielectric} | more}


@pytest.mark.parametrize("kind", TRACERS)
@pytest.mark.parametrize("roughness", [1e-3, 0.2, 1, 50, 1e30])
@pytest.mark.parametrize("side", [1, -1], ids=["into", "out of"])
def test_white_furnace_through_one_surface(
    make_scene: MakeScene, side: int, roughness: float, kind: str
) -> None:
    # Whatever is reflected, refracted or totally reflected ends in an environment of 1; no ray meets the glass twice.
    scene = make_scene(
        camera={"eye": [0, side * 2, 1], "look_at": [0, 0, 0], "vertical_fov": 70},
        environment=WHITE,
        materials=glass(roughness),
        objects=[PLATE],
        integrator={"type": kind, "cutoff": 0, "max_depth": 2},
    )
    picture = render(scene)
    assert np.allclose(picture.linear, 1, rtol=0, atol=1e-6)
    assert picture.receipt.numbers["refraction"] > 500


@pytest.mark.parametrize("kind", TRACERS)
@pytest.mark.parametrize("roughness", [1e-3, 0.2, 1, 50])
@pytest.mark.parametrize("shape", [{"shape": "sphere", "segments": 24}, {"shape": "box"}])
def test_white_furnace_of_a_body_of_index_1(
    make_scene: MakeScene, shape: dict[str, Any], roughness: float, kind: str
) -> None:
    # Without reflection every ray is through after two surfaces.
    scene = make_scene(
        camera={"eye": [1, 2, 3], "look_at": [0, 0, 0]},
        environment=WHITE,
        materials=glass(roughness, index=1),
        objects=[shape | {"material": "glass", "shading": "flat"}],
        integrator={"type": kind, "cutoff": 0, "max_depth": 8},
    )
    assert np.allclose(render(scene).linear, 1, rtol=0, atol=1e-6)


@fewer
@in_both_forms
@pytest.mark.parametrize(("kind", "depth"), [("distribution", 6), ("path", 6), ("path", 64)])
@pytest.mark.parametrize("roughness", [0, 0.01, 0.1, 0.3, 0.5, 0.8, 1])
@pytest.mark.parametrize(
    "shape", [{"shape": "sphere"}, {"shape": "box", "size": [6, 6, 0.3]}], ids=["ball", "plate"]
)
def test_white_furnace_of_frosted_bodies(
    make_scene: MakeScene,
    shape: dict[str, Any],
    roughness: float,
    kind: str,
    depth: int,
    compiled: bool,
) -> None:
    scene = make_scene(
        camera={"eye": [0.4, 0.6, 3.8], "look_at": [0, 0, 0], "vertical_fov": 32},
        environment=WHITE,
        materials=glass(roughness),
        objects=[shape | {"material": "glass"}],
        integrator={"type": kind, "cutoff": 0, "max_depth": depth}
        | ({"roulette": None} if kind == "path" else {}),
    )
    linear = render(scene, compiled=compiled).linear
    if roughness:
        assert np.allclose(linear, 1, rtol=0, atol=1e-5)
    else:
        # Clear glass keeps the share F^5 of what six bounces follow: 1 in 1000 of a ball, most of it at its rim.
        assert linear.mean() > 1 - 2e-3


@pytest.mark.parametrize("roughness", [0.2, 1])
def test_a_frosted_ball_does_not_keep_rays(make_scene: MakeScene, roughness: float) -> None:
    # Mirrored as they are, those that are caught would meet 500 surfaces each: 10 and more for every camera ray.
    scene = make_scene(
        camera={"eye": [0, 0, 4], "look_at": [0, 0, 0], "vertical_fov": 25},
        environment=WHITE,
        materials=glass(roughness),
        objects=[{"shape": "sphere", "material": "glass"}],
        integrator={"type": "path", "cutoff": 0, "max_depth": 500, "roulette": None},
    )
    rays = render(scene, spp=16).receipt.rays
    assert rays["path"] < 5 * rays["camera"]


@pytest.mark.parametrize("kind", TRACERS)
def test_white_furnace_of_a_body_that_is_rough_inside_and_out(
    make_scene: MakeScene, kind: str
) -> None:
    # What gloss jitters inside gets out by itself.
    scene = make_scene(
        camera={"eye": [1, 2, 3], "look_at": [0, 0, 0]},
        environment=WHITE,
        materials=glass(0.2, gloss={"lobe": "phong", "exponent": 1}),
        objects=[{"shape": "sphere", "material": "glass", "segments": 24}],
        integrator={"type": kind, "cutoff": 0, "max_depth": 64},
    )
    picture = render(scene)
    assert np.allclose(picture.linear, 1, rtol=0, atol=1e-5)
    assert "glossy.sample_phong_lobe" in picture.receipt.effects["called"]


def within(alpha: float, roughness: float) -> float:
    """The share of a square of that side, at distance 1, that is less than alpha off its axis."""
    s = np.abs(np.arange(4000) + 0.5 - 2000) / 4000
    height = np.sqrt(np.maximum((math.tan(alpha) / roughness) ** 2 - s**2, 0))
    return float(np.minimum(2 * height, 1).mean())


def shows_the_share_of_the_square(
    scene: Scene, roughness: float, alpha: float, through: float
) -> float:
    """A point shows as much of a red ball of that half-angle, before a green environment, as the square has of it."""
    (red, green, _), (tolerance, *_) = estimate(scene, 256)
    assert red + green == pytest.approx(1, abs=1e-5), "either the ball or the environment"
    assert tolerance < 0.03, "the estimate is worth something"
    # The ball's mesh lies up to 3e-4 radii inside of it.
    least, most = (through * within(a, roughness) for a in (alpha * (1 - 4e-4), alpha))
    assert least - tolerance - 1e-6 <= red <= most + tolerance + 1e-6
    return most


@fewer
@pytest.mark.parametrize("kind", TRACERS)
@pytest.mark.parametrize("degrees", [0.0, 50.0])
@pytest.mark.parametrize("width", [0.5, 0.8, 1.3])
def test_the_cone_behind_the_surface_is_as_wide_as_the_square(
    make_scene: MakeScene, width: float, degrees: float, kind: str
) -> None:
    # A glowing ball behind the surface, about the ray that clear glass would let through, fills the cone of half-angle
    # alpha. The whole square is within tan(alpha) = roughness / sqrt(2).
    roughness = 0.4
    alpha = math.atan(width * roughness / 2)
    angle = math.radians(degrees)
    bent = math.asin(math.sin(angle) / INDEX)
    ball = {
        "type": "sphere",
        "center": [4 * math.sin(bent), -4 * math.cos(bent), 0],
        "radius": 4 * math.sin(alpha),
        "radiance": [1, 0, 0],
    }
    scene = make_scene(
        camera={
            "eye": [-3 * math.sin(angle), 3 * math.cos(angle), 0],
            "look_at": [0, 0, 0],
            "up": [0, 0, -1],
            "vertical_fov": 1e-3,
        },
        film={"width": 16, "height": 16},
        environment={"type": "constant", "radiance": [0, 1, 0]},
        materials=glass(roughness),
        objects=[PLATE],
        lights=[ball],
        integrator={"type": kind, "max_depth": 1},
    )
    through = 1 - fresnel(math.cos(angle), 1 / INDEX)[0]
    most = shows_the_share_of_the_square(scene, roughness, alpha, through)
    if width == 0.5:
        assert most == pytest.approx(through * math.pi / 16, rel=1e-3)


@fewer
@pytest.mark.parametrize("kind", TRACERS)
@pytest.mark.parametrize("width", [0.5, 0.8, 1.3])
def test_total_reflection_inside_is_spread_as_refraction_is(
    make_scene: MakeScene, width: float, kind: str
) -> None:
    # From inside, 60 degrees off the normal; the critical angle of 1.5 is 41.8. About the mirrored direction stands
    # the red ball, which fills the cone of half-angle alpha.
    roughness, angle = 0.4, math.radians(60)
    alpha = math.atan(width * roughness / 2)
    center = [4 * math.sin(angle), -4 * math.cos(angle), 0]
    ball = {"type": "sphere", "center": center, "radius": 4 * math.sin(alpha)}
    scene = make_scene(
        camera={"eye": [-math.sin(angle), -math.cos(angle), 0], "look_at": [0, 0, 0]}
        | {"vertical_fov": 1e-3, "up": [0, 0, -1]},
        film={"width": 16, "height": 16},
        environment={"type": "constant", "radiance": [0, 1, 0]},
        materials=glass(roughness),
        objects=[PLATE],
        lights=[ball | {"radiance": [1, 0, 0]}],
        integrator={"type": kind, "max_depth": 2, "cutoff": 0},
    )
    assert render(scene, spp=1).receipt.rays["refraction"] == 0, "nothing goes through"
    shows_the_share_of_the_square(scene, roughness, alpha, 1)


def caught(
    make_scene: MakeScene, material: dict[str, Any], up: int, kind: str, depth: int
) -> Picture:
    """A camera below glass, 75 degrees off its normal, where all is caught; a red ball is mirrored in it, or behind."""
    x, y = math.sin(math.radians(75)), math.cos(math.radians(75))
    ball = {"type": "sphere", "center": [100 * x, up * 100 * y, 0], "radius": 20}
    scene = make_scene(
        camera={"eye": [-x, -y, 0], "look_at": [0, 0, 0], "vertical_fov": 1},
        environment={"type": "constant", "radiance": [0, 1, 0]},
        materials=material,
        objects=[PLATE],
        lights=[ball | {"radiance": [1, 0, 0]}],
        integrator={"type": kind, "max_depth": depth, "cutoff": 0},
    )
    return render(scene)


@pytest.mark.parametrize("kind", TRACERS)
def test_gloss_takes_the_place_of_the_roughness_inside(make_scene: MakeScene, kind: str) -> None:
    # A lobe as good as a mirror's: all of it shows the red ball.
    sharp = glass(0.5, gloss={"lobe": "plane", "roughness": 1e-3})
    picture = caught(make_scene, sharp, -1, kind, 2)
    assert picture.receipt.rays["refraction"] == 0
    assert "refraction" not in picture.receipt.numbers
    assert np.allclose(picture.linear, [1, 0, 0], rtol=0, atol=1e-6)


@pytest.mark.parametrize("kind", TRACERS)
def test_at_the_last_bounce_what_is_caught_inside_goes_straight_on(
    make_scene: MakeScene, kind: str
) -> None:
    picture = caught(make_scene, glass(0.05), 1, kind, 1)
    assert np.allclose(picture.linear, [1, 0, 0], rtol=0, atol=1e-6)


@pytest.mark.parametrize("kind", TRACERS)
def test_roughness_0_is_clear_glass_bit_for_bit(make_scene: MakeScene, kind: str) -> None:
    pictures = []
    for roughness in (None, 0):
        scene = make_scene(
            camera={"eye": [1, 2, 3], "look_at": [0, 0, 0]},
            environment={"type": "constant", "radiance": [0.5, 0.7, 0.9]},
            materials=glass(roughness) | {"grey": {}},
            objects=[
                {"shape": "sphere", "material": "glass"},
                PLATE | {"material": "grey", "transform": [{"translate": [0, -1, 0]}]},
            ],
            lights=[{"type": "sphere", "center": [0, 5, 2], "radius": 1, "intensity": 60}],
            integrator={"type": kind, "max_depth": 6},
        )
        picture = render(scene)
        assert MODULE not in scene.effects.imported
        assert picture.receipt.effects["skipped"][MODULE] == "no glass is rough"
        assert "refraction" not in picture.receipt.numbers
        pictures.append(picture.linear)
    assert np.array_equal(*pictures)


@pytest.mark.parametrize("kind", TRACERS)
def test_only_rays_through_rough_glass_draw_and_call(make_scene: MakeScene, kind: str) -> None:
    # The left half of the picture is rough glass, the right half clear.
    half = {"shape": "quad", "width": 50, "depth": 100}
    upright = {"rotate": {"axis": [1, 0, 0], "degrees": 90}}
    scene = make_scene(
        environment=WHITE,
        materials={"rough": glass(0.1, index=1)["glass"], "clear": glass(None, index=1)["glass"]},
        objects=[
            half | {"material": name, "transform": [upright, {"translate": [side * 25, 0, 0]}]}
            for name, side in (("rough", -1), ("clear", 1))
        ],
        integrator={"type": kind, "max_depth": 1},
    )
    receipt = render(scene).receipt
    paths = 32 * 32 * 4
    assert receipt.numbers["refraction"] == 2 * paths / 2
    assert set(receipt.effects["called"]) >= FUNCTIONS
    assert MODULE not in receipt.effects["skipped"]
    assert "glossy" not in scene.effects.imported


def test_glass_without_a_bounce_calls_nothing(make_scene: MakeScene) -> None:
    scene = make_scene(
        environment=WHITE, materials=glass(0.1), objects=[PLATE], integrator={"max_depth": 0}
    )
    assert not set(render(scene).receipt.effects["called"]) & FUNCTIONS
    assert MODULE not in scene.effects.imported


def test_refraction_has_dimensions_of_its_own(make_scene: MakeScene) -> None:
    gloss = {"lobe": "ball", "glossiness": 0.2}
    for kind, more in (("distribution", 0), ("path", 2)):
        scene = make_scene(
            camera={"eye": [0, 1, 4], "look_at": [0, 0, 0]},
            materials=glass(0.2, gloss=gloss) | {"grey": {}},
            objects=[
                {"shape": "sphere", "material": "glass"},
                PLATE | {"material": "grey", "transform": [{"translate": [0, -1.1, 0]}]},
            ],
            lights=[{"type": "sphere", "center": [0, 5, 2], "radius": 1, "intensity": 60}],
            integrator={"type": kind, "max_depth": 3, "cutoff": 0, "roulette": None},
        )
        found = numbers_drawn(scene)
        assert len(rows(found)) == len(set(rows(found)))
        # Pixel; at each of four hits the light; of the three that go on gloss and refraction, and in path tracing
        # the way that is taken and where a diffuse hit sends the path. What is inside at the last bounce is let
        # out, so that no gloss is drawn there.
        assert len(found) == 1 + 4 + 3 * (2 + more) - 1
