"""Spherical lamps whose points the module `sampling` places: closed forms, and the pictures of the other functions.

Means over N points are compared in their own standard errors: 6 of them are passed once in 5e8 (normal; N is 40 000).
Pictures are compared by the means of blocks over 16 seeds each, as a difference over its own standard error: with 30
degrees of freedom 8 of them come by chance once in 1e8 (Student's t), for each of 12 blocks in 5 cases.
"""

import math
import re
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.base.errors import SceneError
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.types import Functions
from course.engine.functions.effects import PROJECT, Bound, Effects
from course.engine.scene.building.sampled_points import NUMBERS, SPHERES
from course.engine.terms.lights.sampled import SampledSphereLight
from tests.conftest import MakeScene

Array = NDArray[np.float64]
SOLUTIONS = Effects(PROJECT / "solutions")
WAYS = ("sphere by polar", "ball by polar", "ball by rejection")
LAMP = {"type": "sphere", "center": [0.3, 2.4, 0.2], "radius": 0.8, "intensity": 9}
N = 40_000


def numbers(samples: str, seed: int = 0) -> Any:
    return np.random.default_rng(seed).random((NUMBERS.get(samples, 2), N), np.float32)


def far(values: Array, mean: float) -> float:
    """How many standard errors the mean of values is off."""
    return abs(float(values.mean()) - mean) / (float(values.std(ddof=1)) / math.sqrt(len(values)))


def points(samples: str, center: Any, radius: float, u: Any) -> Any:
    """Points (3, n) of a lamp: the ways to it from the origin."""
    functions = Bound(SOLUTIONS).functions(*SPHERES[samples], asked_by=("lights", 0))
    known = "lamp", center, radius, False, np.ones(3, np.float32), samples, Functions()
    light = SampledSphereLight(*known, len(u), None, functions)
    return light.sample(np.zeros((3, u.shape[1]), np.float32), u).to_light


@pytest.mark.parametrize("samples", WAYS)
def test_points_have_the_moments_of_the_lamp(samples: str) -> None:
    center, radius = np.array([3.0, -1.0, 0.5], np.float32), 0.25
    found = points(samples, center, radius, numbers(samples))
    assert found.shape == (3, N)
    assert found.dtype == np.float32
    x, y, z = (found.astype(float) - center[:, None]) / radius
    ball = samples.startswith("ball")
    squared = x * x + y * y + z * z
    assert squared.max() <= 1 + 1e-5
    if ball:
        # The volume within r grows with r^3: r^3 is uniform.
        assert far(squared**1.5, 1 / 2) < 6
    else:
        assert squared.min() >= 1 - 1e-5
    for a in (x, y, z):
        assert far(a, 0) < 6
        assert far(a * a, 1 / 5 if ball else 1 / 3) < 6
        assert far(a**4, 3 / 35 if ball else 1 / 5) < 6
    for a, b in ((x, y), (y, z), (z, x)):
        assert far(a * b, 0) < 6


def test_rejection_draws_the_same_for_the_same_numbers_and_others_for_others() -> None:
    way, center = "ball by rejection", np.zeros(3, np.float32)
    one, other = numbers(way, 1), numbers(way, 2)
    first, again, elsewhere = (points(way, center, 1.0, u) for u in (one, one, other))
    assert (first == again).all()
    assert not (first == elsewhere).any()
    assert points(way, center, 1.0, one[:, :0]).shape == (3, 0)


def test_the_other_ways_call_what_they_called(make_scene: MakeScene) -> None:
    for samples, (module, name) in SPHERES.items():
        if module == "soft_shadows":
            scene = lit(make_scene, samples=samples)
            (light,) = scene.compiled.world.lights
            assert type(light) is SphereLight
            assert vars(light.soft_shadows) == {name: scene.effects.function(module, name)}
            # So it is that which places the points: there is no other to call.
            u = np.full((light.width, 1), 0.3, np.float32)
            assert light.sample(np.zeros((3, 1), np.float32), u).to_light.shape == (3, 1)


def lit(make_scene: MakeScene, integrator: str = "distribution", **light: Any) -> Scene:
    """A floor in the shadow of a plate, most of it penumbra."""
    return make_scene(
        camera={"eye": [0, 3, 0.01], "look_at": [0, 0, 0], "vertical_fov": 40, "up": [0, 0, -1]},
        film={"width": 16, "height": 12},
        integrator={"type": integrator, "max_depth": 2},
        materials={"grey": {"color": 0.8, "specular": 0.2}},
        objects=[
            {"shape": "quad", "material": "grey", "width": 9, "depth": 9},
            {"shape": "quad", "material": "grey", "width": 1, "depth": 4}
            | {"transform": [{"translate": [0.5, 0.9, 0]}]},
        ],
        lights=[LAMP | light],
    )


SEEDS = 16


def blocks(scene: Scene, samples: int = 32, **options: Any) -> Array:
    """(SEEDS, 3, 4) means of blocks."""
    pictures = [render(scene, spp=samples, seed=seed, **options).linear for seed in range(SEEDS)]
    gray = np.stack(pictures).astype(float).mean(axis=-1)
    return np.asarray(gray.reshape(SEEDS, 3, 4, 4, 4).mean(axis=(2, 4)))


def apart(a: Array, b: Array) -> float:
    """The largest difference between two means of blocks, in its standard errors."""
    error = np.sqrt((a.var(axis=0, ddof=1) + b.var(axis=0, ddof=1)) / SEEDS)
    return float((np.abs(a.mean(axis=0) - b.mean(axis=0)) / error).max())


@pytest.mark.parametrize(
    ("samples", "like", "light"),
    [
        ("sphere by polar", "sphere", {}),
        ("ball by polar", "ball", {}),
        ("ball by rejection", "ball", {}),
        # Beside the camera's view.
        ("sphere by polar", "sphere", {"center": [1.7, 2.2, 0], "intensity": None, "radiance": 4}),
        ("ball by rejection", "ball", {"motion": {"velocity": [0.4, 0, 0]}}),
    ],
)
def test_the_penumbra_is_that_of_the_function_of_soft_shadows(
    make_scene: MakeScene, samples: str, like: str, light: dict[str, Any]
) -> None:
    expected = blocks(lit(make_scene, **light, samples=like))
    assert apart(blocks(lit(make_scene, **light, samples=samples)), expected) < 8
    # A lamp a fifth as wide is told from it.
    small = light | {"radius": 0.16}
    if "radiance" in light:
        small |= {"radiance": 25 * light["radiance"]}
    assert apart(blocks(lit(make_scene, **small, samples=samples)), expected) > 16


def test_a_surface_is_told_from_a_ball(make_scene: MakeScene) -> None:
    sphere, ball = (
        blocks(lit(make_scene, samples=samples), 128)
        for samples in ("sphere by polar", "ball by polar")
    )
    assert apart(sphere, ball) > 12


@pytest.mark.parametrize("integrator", ["distribution", "path"])
@pytest.mark.parametrize("samples", WAYS)
def test_a_picture_is_repeated_with_any_number_of_threads(
    make_scene: MakeScene, samples: str, integrator: str
) -> None:
    scene = lit(make_scene, integrator, samples=samples)
    one = render(scene, spp=24, threads=1, size=(80, 60)).linear
    assert one.tobytes() == render(scene, spp=24, threads=2, size=(80, 60)).linear.tobytes()
    assert one.tobytes() != render(scene, spp=24, seed=1, size=(80, 60)).linear.tobytes()


@pytest.mark.parametrize("error", [None, 0.02])
def test_so_is_one_through_a_lens_by_rejection(make_scene: MakeScene, error: float | None) -> None:
    """Which paths are followed together makes a difference to such points, and must not come from the threads."""
    lens = {"aperture_radius": 0.2, "focus_distance": 3, "samples": "rejection"}
    scene = make_scene(
        camera={"eye": [0, 1, 4], "look_at": [0, 0, 0], "lens": lens},
        integrator={"type": "path", "max_depth": 2},
        materials={"grey": {"color": 0.5}},
        objects=[{"shape": "quad", "material": "grey", "width": 4, "depth": 4}],
        lights=[{"type": "point", "position": [0, 3, 1], "intensity": 20}],
    )
    asked = {"spp": 64, "size": (120, 90), "error": error}
    one = render(scene, threads=1, **asked).linear
    for threads in (2, 5):
        assert one.tobytes() == render(scene, threads=threads, **asked).linear.tobytes()


@pytest.mark.parametrize("samples", WAYS)
def test_a_receipt_names_the_function_and_what_it_draws(
    make_scene: MakeScene, samples: str
) -> None:
    scene = lit(make_scene, samples=samples)
    receipt = render(scene, spp=4).receipt
    called = [name for name in receipt.effects["called"] if name.startswith("sampling.")]
    assert called == [f"sampling.{samples.replace(' ', '_')}"]
    width = 3 if samples == "ball by polar" else 2
    assert receipt.numbers["light 0"] == width * 16 * 12 * 4
    assert "soft_shadows" in receipt.effects["skipped"]
    assert "soft_shadows" not in scene.effects.imported


@pytest.mark.parametrize("samples", ["ball by polar", "ball by rejection"])
def test_a_lamp_by_radiance_shines_from_its_surface(make_scene: MakeScene, samples: str) -> None:
    message = re.escape(
        f'lights[0].samples is "{samples}": expected "sphere", "sphere by polar" or "visible" for a light by radiance'
    )
    with pytest.raises(SceneError, match=message):
        lit(make_scene, intensity=None, radiance=4, samples=samples)


def test_a_lamp_of_radius_0_is_a_point_and_calls_nothing(make_scene: MakeScene) -> None:
    scene = lit(make_scene, radius=0, samples="ball by rejection")
    receipt = render(scene, spp=1).receipt
    assert "sampling" not in scene.effects.imported
    assert "light 0" not in receipt.numbers
