"""Light from pictures of the sky by the functions of the module environment_light: means, noise, and what is called.

A mean of 1024 pixels is within 5 of its standard errors with a false-fail rate of 6e-7 each; four are tested.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import render
from course.engine.core.vectors import dot
from course.engine.formats.pictures.files import save
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_variant
from course.engine.terms.environments.light import PictureSampling
from tests.conftest import MakeScene
from tests.engine.terms.environments.test_hemisphere_directions import check_mean, estimates, floor

WAYS = ("inversion", "alias")
CALLS = {
    "inversion": {"texel_weights", "cumulate", "sample_direction", "density"},
    "alias": {"texel_weights", "alias_table", "draw_alias", "density"},
}


@pytest.fixture(params=WAYS)
def way(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def sky(way: str, **keys: Any) -> dict[str, Any]:
    return {"type": "constant", "radiance": 1, "lights": True, "sampling": way} | keys


def spot(folder: Path, height: int = 64) -> None:
    """One bright texel in a sky that is black otherwise."""
    picture = np.zeros((3, height, 2 * height), np.float32)
    picture[:, 10, 100] = 1000
    save(folder / "spot.exr", picture)


def test_under_an_even_sky_a_white_floor_is_white(make_scene: MakeScene, way: str) -> None:
    check_mean(estimates(floor(make_scene, sky(way))), 1.0, 1e-4)


def test_all_light_of_an_interpolated_texel_is_found(
    make_scene: MakeScene, tmp_path: Path, way: str
) -> None:
    """The mean is that of directions that know nothing of the picture, but for noise."""
    spot(tmp_path)
    picture = {"type": "lat_long", "image": "spot.exr", "lights": True}
    scene = floor(make_scene, picture | {"sampling": way})
    assert isinstance(scene.compiled.world.sky, PictureSampling)
    # By the midpoints of four million cells of the sphere.
    phi, y = np.meshgrid((np.arange(4000) + 0.5) / 4000 * 2 * np.pi, (np.arange(1000) + 0.5) / 1000)
    ring = np.sqrt(1 - y * y)
    direction = np.stack((ring * np.sin(phi), y, ring * np.cos(phi))).reshape(3, -1)
    environment = scene.compiled.world.environment
    assert environment is not None
    radiance = environment.radiance(direction.astype(np.float32))[0].astype(np.float64)
    expected = 2 * float((radiance * direction[1]).mean())
    check_mean(estimates(scene), expected, 2e-3 * expected)


def test_there_is_a_density_wherever_a_lookup_finds_light(
    make_scene: MakeScene, tmp_path: Path, way: str
) -> None:
    spot(tmp_path)
    picture = {"type": "lat_long", "image": "spot.exr", "lights": True}
    world = floor(make_scene, picture | {"sampling": way}).compiled.world
    assert isinstance(world.sky, PictureSampling)
    assert world.environment is not None
    direction = np.random.default_rng(6).normal(size=(3, 400_000))
    direction = (direction / np.linalg.norm(direction, axis=0)).astype(np.float32)
    lit = (world.environment.radiance(direction) > 0).all(axis=0)
    assert lit.sum() > 100
    density = world.sky.environment_light.density(world.sky.weights, direction)
    assert (density[lit] > 0).all()


def test_under_an_even_sky_all_directions_are_alike(make_scene: MakeScene, way: str) -> None:
    """Heights are uniform by Kolmogorov's test, which fails a right sampling once in 10^7 runs."""
    sampling = floor(make_scene, sky(way)).compiled.world.sky
    assert isinstance(sampling, PictureSampling)
    n = 400_000
    normal = np.repeat(np.array([[0], [1], [0]], np.float32), n, axis=1)
    direction, _ = sampling.sample(normal, np.random.default_rng(7).random((2, n), np.float32))
    share = np.sort((direction[1].astype(np.float64) + 1) / 2)
    assert np.abs(share - (np.arange(n) + 0.5) / n).max() * np.sqrt(n) < 2.9


def test_weights_are_cosine_over_pi_times_density(
    make_scene: MakeScene, tmp_path: Path, way: str
) -> None:
    spot(tmp_path)
    picture = {"type": "lat_long", "image": "spot.exr", "lights": True}
    sampling = floor(make_scene, picture | {"sampling": way}).compiled.world.sky
    assert isinstance(sampling, PictureSampling)
    rng = np.random.default_rng(5)
    normal = rng.normal(size=(3, 500))
    normal = (normal / np.linalg.norm(normal, axis=0)).astype(np.float32)
    direction, weight = sampling.sample(normal, rng.random((2, 500), np.float32))
    found = sampling.environment_light.density(sampling.weights, direction)
    assert (found > 0).all()
    np.testing.assert_allclose(weight, dot(normal, direction) / (np.pi * found), rtol=1e-5)


def test_it_says_which_functions_are_called(make_scene: MakeScene, way: str) -> None:
    effects = render(floor(make_scene, sky(way)), spp=1).receipt.effects
    called = {name for name in effects["called"] if name.startswith("environment_light.")}
    assert called == {f"environment_light.{name}" for name in CALLS[way]}
    assert "environment_light" not in effects["skipped"]


@pytest.mark.parametrize(
    "environment", [sky("cosine"), sky("alias", lights=False), sky("alias", radiance=0)]
)
def test_where_no_direction_is_chosen_the_module_is_not_imported(
    make_scene: MakeScene, environment: dict[str, Any]
) -> None:
    scene = floor(make_scene, environment)
    effects = render(scene, spp=1).receipt.effects
    assert "by its picture" in effects["skipped"]["environment_light"]
    assert "environment_light" not in scene.effects.imported


def test_the_scene_is_far_less_noisy_than_its_twin() -> None:
    noise = []
    for folder in ("", "before"):
        path = PROJECT / "scenes" / folder / "environment_light.yaml"
        # Mirrored suns are as noisy in both.
        scene = load_variant(path, {("integrator", "max_depth"): 0})
        seeds = [render(scene, size=(90, 60), seed=seed, compiled=False).linear for seed in (1, 2)]
        noise.append(np.std(seeds[0] - seeds[1]))
    assert noise[1] > 8 * noise[0]
