"""Path tracing against closed forms: what every reflection adds, skies that count once, and paths that end by chance.

Where every path brings the same there is no noise, and the tolerance is that of float32 sums. Else pixels of the
random sampler are independent estimates of one number, whose mean is within 5.33 of its standard errors (false-fail
rate 1e-7 for each of the about 40 numbers, 4e-6 for the file).
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.base.errors import SceneError
from course.engine import shapes
from course.engine.core import tiles
from course.engine.core.rays import RAYS
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_scene
from course.engine.terms import plan, work
from course.engine.terms.paths import path_tracing
from course.engine.terms.paths import pieces as path_pieces
from tests.conftest import MakeScene
from tests.engine.terms.lights.over_a_floor import assert_mean
from tests.lengths import fewer

pytestmark = pytest.mark.usefixtures("each_form")

Array = NDArray[np.float64]

INSIDE = {"eye": [0.1, 0.05, 0.2], "look_at": [1, 0.3, 0.2], "vertical_fov": 70}
BOX = {"shape": "box", "material": "m", "size": [2, 2, 2]}
BALL = {"shape": "sphere", "material": "m", "radius": 1, "segments": 24}
ONE = {"type": "random", "samples": 1}
SIGMAS = 5.33


def paths(**more: Any) -> dict[str, Any]:
    return {"type": "path", "max_depth": 400, "roulette": None} | more


def furnace(
    make_scene: MakeScene, material: dict[str, Any], glows: bool = False, **more: Any
) -> Scene:
    """Inside a closed box whose walls give off 1 by themselves, by their emission or by an ambient term."""
    color = material["color"]
    parts: dict[str, Any] = {
        "camera": INSIDE,
        "materials": {"m": material | ({"emission": 1} if glows else {})},
        "objects": [BOX],
        "lights": [] if glows else [{"type": "ambient", "radiance": 1 / color}],
        "sampler": ONE,
        "integrator": paths(),
    }
    return make_scene(**parts | more)


# ---------------------------------------------------------------- furnaces


glow = pytest.mark.parametrize("glows", [False, True], ids=["ambient", "emission"])


@fewer
@glow
@pytest.mark.parametrize(("reflectance", "shape"), [(0.1, BOX), (0.5, BALL), (0.95, BOX)])
def test_a_furnace_adds_up_every_reflection(
    make_scene: MakeScene, reflectance: float, shape: dict[str, Any], glows: bool
) -> None:
    scene = furnace(make_scene, {"color": reflectance}, glows, objects=[shape])
    assert np.allclose(render(scene).linear, 1 / (1 - reflectance), rtol=1e-5)


def test_each_channel_glows_by_its_own_emission_even_if_nothing_is_reflected(
    make_scene: MakeScene,
) -> None:
    emission = np.array([1, 2, 0.5])
    for color in (0, 0.5):
        material = {"color": color, "emission": emission.tolist()}
        scene = furnace(make_scene, {"color": 1}, glows=True, materials={"m": material})
        assert np.allclose(render(scene).linear, emission / (1 - color), rtol=1e-5)


@pytest.mark.parametrize("depth", [0, 1, 3, 10])
def test_the_depth_is_the_number_of_bounces(make_scene: MakeScene, depth: int) -> None:
    scene = furnace(make_scene, {"color": 0.8}, integrator=paths(max_depth=depth))
    assert np.allclose(render(scene).linear, (1 - 0.8 ** (depth + 1)) / (1 - 0.8), rtol=1e-5)


@fewer
@pytest.mark.parametrize(
    "optics",
    [
        {"mirror": 0.3},
        {"mirror": 0.3, "gloss": {"lobe": "phong", "exponent": 5}},
        {"mirror": 0.3, "gloss": {"lobe": "ball", "glossiness": 0.6}},
    ],
    ids=["mirror", "phong", "ball"],
)
@glow
def test_one_way_is_followed_and_stands_for_all(
    make_scene: MakeScene, optics: dict[str, Any], glows: bool
) -> None:
    """Scattered or mirrored, chosen as their shares are: 0.8 comes back either way, so there is no noise."""
    deep = paths(max_depth=100)
    scene = furnace(make_scene, {"color": 0.5} | optics, glows, integrator=deep)
    picture = render(scene)
    assert np.allclose(picture.linear, 1 / (1 - 0.8), rtol=1e-4)
    # One ray a path and bounce, not two.
    assert picture.receipt.rays["path"] == 100 * 32 * 32


@fewer
@pytest.mark.parametrize("roulette", [0, 3])
def test_russian_roulette_keeps_the_mean(make_scene: MakeScene, roulette: int) -> None:
    color = [0.5, 0.7, 0.9]
    scene = make_scene(
        camera=INSIDE,
        materials={"m": {"color": color}},
        objects=[BOX],
        lights=[{"type": "ambient", "radiance": 1}],
        film={"width": 64, "height": 64},
        sampler={"type": "random", "samples": 16},
        integrator=paths(roulette=roulette),
    )
    picture = render(scene)
    assert_mean(picture, [r / (1 - r) for r in color], offset=1e-5)
    # It ends paths: the largest channel lives for 1 / (1 - 0.9) bounces on average.
    assert picture.receipt.rays["path"] < (roulette + 11) * 64 * 64 * 16


@pytest.mark.parametrize("roulette", [0, 1, 3])
def test_paths_are_safe_before_the_roulette_begins(make_scene: MakeScene, roulette: int) -> None:
    """After that many bounces one game: a path of throughput 0.8^(roulette + 1) survives as often."""
    more = {"film": {"width": 64, "height": 64}, "sampler": {"type": "random", "samples": 16}}
    deep = paths(max_depth=roulette + 1, roulette=roulette)
    rays = render(furnace(make_scene, {"color": 0.8}, integrator=deep, **more)).receipt.rays
    n, q = 64 * 64 * 16, 0.8 ** (roulette + 1)
    assert abs(rays["path"] / n - roulette - q) <= SIGMAS * math.sqrt(q * (1 - q) / n)


def test_clear_glass_in_a_white_room_can_not_be_seen(make_scene: MakeScene) -> None:
    """Reflected or refracted by chance, each as often as its share is."""
    scene = make_scene(
        materials={"m": {"dielectric": {"refraction_index": 1.5}, "color": 0}},
        objects=[BALL],
        environment={"type": "constant", "radiance": 1},
        sampler={"type": "random", "samples": 4},
        integrator=paths(),
    )
    assert np.allclose(render(scene).linear, 1, rtol=1e-5)


@pytest.mark.parametrize("sampler", ["random", "sobol"])
def test_glass_swallows_what_beers_law_says(make_scene: MakeScene, sampler: str) -> None:
    """A slab, seen head on: all reflections inside, R + T^2 R + ... in closed form."""
    absorption, thickness, reflectance = 0.7, 0.5, ((1.5 - 1) / (1.5 + 1)) ** 2
    glass = {"refraction_index": 1.5, "absorption": absorption}
    scene = make_scene(
        camera={"eye": [0, 0, 4], "look_at": [0, 0, 0], "vertical_fov": 0.01},
        materials={"m": {"dielectric": glass, "color": 0}},
        objects=[{"shape": "box", "material": "m", "size": [4, 4, thickness]}],
        environment={"type": "constant", "radiance": 1},
        sampler={"type": sampler, "samples": 16},
        integrator=paths(),
    )
    left = math.exp(-absorption * thickness)
    through = (1 - reflectance) ** 2 * left / (1 - reflectance * left)
    assert_mean(render(scene), reflectance + through, offset=1e-5)


# ---------------------------------------------------------------- light from wall to wall


def two_halves(folder: Path) -> list[dict[str, Any]]:
    """A ball of two materials as two meshes."""
    ball = shapes.sphere(1.0, 128)
    upper = ball.vertices[ball.triangles].mean(axis=1)[:, 1] > 0
    objects = []
    for name, chosen in (("above", upper), ("below", ~upper)):
        lines = ["v {} {} {}".format(*v) for v in ball.vertices]
        lines += ["f {} {} {}".format(*(t + 1)) for t in ball.triangles[chosen]]
        (folder / f"{name}.obj").write_text("\n".join(lines), encoding="utf-8")
        objects.append({"shape": "mesh", "file": f"{name}.obj", "material": name})
    return [thing | {"shading": "flat"} for thing in objects]


@fewer
@pytest.mark.parametrize(
    ("half", "roulette"), [("above", None), ("above", 2), ("below", 0), ("below", 3)]
)
def test_one_half_of_a_ball_colours_the_other(
    make_scene: MakeScene, tmp_path: Path, half: str, roulette: int | None
) -> None:
    """Inside a ball every point sends each point the same: the walls are lit by their mean.

    With a point light of intensity I in the middle of a ball of radius 1 the radiosity of a half is
    rho E / (1 - mean rho), E = I.
    """
    above, below = np.array([0.9, 0.2, 0.1]), np.array([0.7, 0.7, 0.3])
    colors = {"above": above, "below": below}
    scene = make_scene(
        camera={"eye": [0.1, 0.05, 0.2], "vertical_fov": 30, "up": [1, 0, 0]}
        | {"look_at": [0, 1 if half == "above" else -1, 0.1]},
        film={"width": 28, "height": 28},
        materials={name: {"color": list(color)} for name, color in colors.items()},
        objects=two_halves(tmp_path),
        lights=[{"type": "point", "position": [0, 0, 0], "intensity": math.pi}],
        sampler={"type": "random", "samples": 16},
        # What is left after 70 bounces: 0.8^70 = 2e-7.
        integrator=paths(roulette=roulette, max_depth=70),
    )
    # The flat triangles lie inside the ball by up to 3e-4 of its radius.
    assert_mean(render(scene), colors[half] / (1 - (above + below) / 2), offset=1e-3)


# ---------------------------------------------------------------- surroundings count once


@pytest.mark.parametrize("lights", [True, False])
def test_a_surrounding_counts_once(make_scene: MakeScene, lights: bool) -> None:
    """A ball in a white room: by shadow rays r of it, and nothing where it is said to light nothing."""
    scene = make_scene(
        camera={"eye": [0, 0, 4], "look_at": [0, 0, 0], "vertical_fov": 5},
        materials={"m": {"color": 0.6}},
        objects=[BALL | {"shading": "flat"}],
        environment={"type": "constant", "radiance": 2, "lights": lights},
        sampler=ONE,
        integrator=paths(max_depth=5),
    )
    assert np.allclose(render(scene).linear, 1.2 if lights else 0, rtol=1e-5)


def test_a_surrounding_counts_once_for_scattered_and_once_for_mirrored_light(
    make_scene: MakeScene,
) -> None:
    scene = make_scene(
        camera={"eye": [0, 0, 4], "look_at": [0, 0, 0], "vertical_fov": 5},
        materials={"m": {"color": 0.6, "mirror": 0.3}},
        objects=[BALL | {"shading": "flat"}],
        environment={"type": "constant", "radiance": 2, "lights": True},
        sampler={"type": "random", "samples": 16},
        integrator=paths(max_depth=5),
    )
    assert_mean(render(scene), 2 * (0.6 + 0.3), offset=1e-5)


def test_what_is_seen_through_a_mirror_or_glass_is_as_the_distribution_ray_tracer_shows_it(
    make_scene: MakeScene,
) -> None:
    """Without diffuse surfaces both follow the same light; one by all ways at once, one by chance."""
    scene: dict[str, Any] = {
        "camera": {"eye": [0, 0.5, 3], "look_at": [0, 0, 0], "vertical_fov": 50},
        "film": {"width": 20, "height": 20},
        "materials": {
            "m": {"color": 0, "dielectric": {"refraction_index": 1.5, "absorption": 0.3}},
            "mirror": {"color": 0, "mirror": [0.9, 0.5, 0.3]},
        },
        "objects": [
            BALL | {"radius": 0.6},
            {"shape": "quad", "material": "mirror", "width": 9, "depth": 9}
            | {"transform": [{"translate": [0, -0.8, 0]}]},
        ],
        "environment": {"type": "constant", "radiance": [0.2, 0.5, 1.0]},
        "lights": [{"type": "sphere", "center": [1, 1.5, -1], "radius": 0.5, "radiance": 3}],
        "sampler": {"type": "random", "samples": 64},
    }
    exact = render(make_scene(**scene, integrator={"max_depth": 9, "cutoff": 0})).linear
    shown = [
        render(make_scene(**scene, integrator=paths(max_depth=9)), seed=seed).linear.mean(axis=0)
        for seed in range(8)
    ]
    rows = np.array(shown, np.float64)
    error = rows.std(axis=0, ddof=1) / math.sqrt(8)
    t = (rows.mean(axis=0) - exact.mean(axis=0)) / np.maximum(error, 1e-4)
    # 72 of Student's t with 7 degrees of freedom (a little noisier: the other picture's noise): 1e-7 in all is at 40.
    assert np.abs(t).max() < 40
    assert np.abs(rows.mean() / exact.mean() - 1) < 0.01


# ---------------------------------------------------------------- contract of the engine


def everything(make_scene: MakeScene, **more: Any) -> Scene:
    """Scattering, mirrors, gloss, coloured glass, a lens, motion, a sky and a lamp."""
    parts: dict[str, Any] = {
        "camera": {"eye": [0, 1, 4], "look_at": [0, 0.4, 0]}
        | {"lens": {"aperture_radius": 0.05, "focus_distance": 4}},
        "film": {"width": 80, "height": 70},
        "materials": {
            "m": {"color": [0.7, 0.5, 0.3], "mirror": 0.1},
            "gloss": {"mirror": 0.8, "color": 0.1, "gloss": {"lobe": "phong", "exponent": 40}},
            "glass": {"color": 0, "dielectric": {"absorption": [0.1, 0.5, 1]}},
        },
        "objects": [
            {"shape": "quad", "material": "m", "width": 6, "depth": 6},
            {"shape": "sphere", "material": "gloss", "radius": 0.4}
            | {"transform": [{"translate": [-0.6, 0.4, 0]}], "motion": {"velocity": [0.3, 0, 0]}},
            {"shape": "sphere", "material": "glass", "radius": 0.4}
            | {"transform": [{"translate": [0.5, 0.4, 0.4]}]},
        ],
        "environment": {"type": "constant", "radiance": 0.3, "lights": True},
        "lights": [{"type": "sphere", "center": [1, 3, 1], "radius": 0.3, "radiance": 8}],
        "sampler": {"type": "sobol", "samples": 24},
        "integrator": {"type": "path", "max_depth": 8},
    }
    return make_scene(**parts | more)


def test_batches_that_are_followed_together_give_the_same_bits(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene = load_scene(PROJECT / "scenes" / "path_tracing.yaml")
    monkeypatch.setattr(work, "SHARES", 1)
    # As if a picture of four times the pixels were rendered.
    for part in (tiles, work, path_pieces, path_tracing):
        monkeypatch.setattr(part, "RAYS", RAYS // 4)

    def picture(batches: int, **settings: Any) -> bytes:
        monkeypatch.setattr(plan, "PIECES", batches)
        return render(scene, size=(70, 65), spp=16, **settings).linear.tobytes()

    # 4.4 batches of rays, in tiles of one, of two and of four.
    one = picture(1)
    assert one == picture(2) == picture(4, threads=1) == picture(4, threads=3)
    assert picture(1, error=0.05) == picture(4, error=0.05)
    # Batches that wait for others at many depths, and some that overtake those that wait.
    monkeypatch.setattr(path_pieces, "RAYS", 750)
    monkeypatch.setattr(path_tracing, "RAYS", 750)
    assert picture(64) == one


def test_the_receipt_says_what_was_called(make_scene: MakeScene) -> None:
    receipt = render(everything(make_scene), spp=4).receipt
    called = receipt.effects["called"]
    assert {
        "path_tracing.diffuse_bounce",
        "path_tracing.throughput",
        "path_tracing.russian_roulette",
    } <= set(called)
    assert receipt.rays["path"] > 0
    assert {"bounce", "choice"} <= set(receipt.numbers)


@pytest.mark.parametrize(
    ("integrator", "missing"),
    [
        ({"type": "distribution"}, {"diffuse_bounce", "throughput", "russian_roulette"}),
        ({"type": "path", "max_depth": 0}, {"diffuse_bounce", "throughput", "russian_roulette"}),
        ({"type": "path", "roulette": None}, {"russian_roulette"}),
        ({"type": "path", "roulette": 5, "max_depth": 5}, {"russian_roulette"}),
    ],
)
def test_what_is_not_needed_is_not_called(
    make_scene: MakeScene, integrator: dict[str, Any], missing: set[str]
) -> None:
    scene = everything(make_scene, integrator=integrator)
    receipt = render(scene, spp=4).receipt
    called = {name.partition(".")[2] for name in receipt.effects["called"]}
    assert not called & missing
    assert ("path_tracing" in scene.effects.imported) == (len(missing) < 3)
    if integrator["type"] == "distribution":
        assert "path" not in receipt.rays
        assert not {"bounce", "choice"} & set(receipt.numbers)


def test_another_integrator_is_refused_by_name(make_scene: MakeScene) -> None:
    with pytest.raises(SceneError, match=r"integrator\.type"):
        everything(make_scene, integrator={"type": "bidirectional"})
