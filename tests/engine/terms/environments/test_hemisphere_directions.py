"""Directions towards an environment by the functions of the importance_sampling module: means and variances.

Under an even sky of radiance 1 a white floor has radiance 1, whichever way directions are chosen; its 1024 pixels are
independent estimates of that. A mean is within 5 of its standard errors with a false-fail rate of 6e-7; a sample
variance of 1024 nearly normal means is within 0.25 of the true one, 5.6 of its standard deviations, with one of 2e-8.
Some thirty such numbers are tested here, with fixed seeds.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from numpy.typing import NDArray

from course import Scene, SceneError, load_scene, render
from course.engine.core.environment import CubeEnvironment
from course.engine.core.vectors import dot
from course.engine.formats.pictures.files import save
from course.engine.functions.effects import PROJECT
from course.engine.terms.environments.hemispheres import HemisphereSampling
from tests.conftest import MakeScene
from tests.lengths import fewer

Array = NDArray[np.float64]

WAYS = ("uniform", "cosine", "power")
SAMPLES = 64
FLOOR = {"shape": "quad", "material": "white", "width": 6, "depth": 6}
# A disk as high above the point that is looked at as its radius: it hides half of the cosine-weighted sky.
LID = {"shape": "disk", "material": "black", "radius": 1, "segments": 1024} | {
    "transform": [{"translate": [0, 1, 0]}]
}
CALLS = {
    "uniform": {"uniform_hemisphere", "phong_lobe_pdf"},
    "cosine": {"cosine_hemisphere", "cosine_hemisphere_pdf"},
}
CALLS["power"] = CALLS["uniform"] | CALLS["cosine"] | {"power_heuristic"}


def _variance_by_power() -> float:
    """Of one sample of the two ways, under an even sky, by the middles of a million strata of the cosine c.

    The squared weights, 2 / (1 + 1 / (2 c)^2) and its complement times cosine over pi times density, are 16 c^2 and
    64 c^4 over (1 + 4 c^2)^2; uniform directions have density 1 in c, cosine-weighted ones 2 c.
    """
    c = (np.arange(10**6) + 0.5) / 10**6
    below = (1 + 4 * c * c) ** 2
    return float(np.mean(0.5 * 16 * c**2 / below + 0.5 * 64 * c**4 / below * 2 * c)) - 1


# Uniform: the weight is 2 c, whose mean square is 4/3.
VARIANCES = {"uniform": 1 / 3, "cosine": 0.0, "power": _variance_by_power()}


def sky(way: str, **keys: Any) -> dict[str, Any]:
    return {"type": "constant", "radiance": 1, "lights": True, "sampling": way} | keys


def floor(make_scene: MakeScene, environment: dict[str, Any], *above: dict[str, Any]) -> Scene:
    """What is seen from the side is one point of the floor, under what hides the sky."""
    return make_scene(
        camera={"eye": [4, 0.5, 0], "look_at": [0, 0, 0], "vertical_fov": 1e-4},
        sampler={"type": "random", "samples": SAMPLES},
        environment=environment,
        materials={"white": {"color": 1}, "black": {"color": 0}},
        objects=[FLOOR, *above],
        integrator={"max_depth": 0},
    )


def estimates(scene: Scene, seed: int = 3) -> Array:
    return render(scene, seed=seed, compiled=False).linear[..., 0].ravel().astype(np.float64)


def check_mean(found: Array, expected: float, tolerance: float = 0.0) -> None:
    error = found.std(ddof=1) / np.sqrt(found.size)
    assert abs(found.mean() - expected) <= 5 * error + tolerance


@pytest.mark.parametrize("way", WAYS)
def test_an_open_sky_has_the_mean_and_the_variance_of_the_closed_form(
    make_scene: MakeScene, way: str
) -> None:
    found = estimates(floor(make_scene, sky(way)))
    check_mean(found, 1.0, 1e-5)
    variance = SAMPLES * found.var(ddof=1)
    if VARIANCES[way]:
        assert variance == pytest.approx(VARIANCES[way], rel=0.25)
    else:
        # The cosine cancels: nothing is left but rounding.
        assert variance < 1e-8


def test_the_variances_are_in_the_order_that_the_module_promises() -> None:
    assert 0 == VARIANCES["cosine"] < VARIANCES["power"] < VARIANCES["uniform"]


@pytest.mark.parametrize("way", WAYS)
def test_half_of_the_sky_is_hidden_by_a_lid(make_scene: MakeScene, way: str) -> None:
    # The polygon of 1024 sides is smaller than the disk by 6e-6 of its area; shadow rays start above the floor by less.
    check_mean(estimates(floor(make_scene, sky(way), LID)), 0.5, 1e-4)


@fewer
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("kind", ["lat_long", "cube"])
def test_pictures_of_the_sky_are_sampled_alike(
    make_scene: MakeScene, tmp_path: Path, kind: str, way: str
) -> None:
    """Radiance 1 + y of the direction: over a floor its mean weighed by the cosine is 1 + 2/3."""
    if kind == "cube":
        save(tmp_path / "top.exr", np.full((3, 8, 8), 1.5, np.float32))
        environment, expected = {"type": "cube", "faces": ["top.exr"] * 6}, 1.5
    else:
        height = 256
        y = np.cos((np.arange(height) + 0.5) / height * np.pi)
        rows = np.repeat((1 + y)[None, :, None], 3, axis=0)
        save(
            tmp_path / "sky.exr", np.repeat(rows, 2 * height, axis=2).astype(np.float32, order="C")
        )
        environment, expected = {"type": "lat_long", "image": "sky.exr"}, 5 / 3
    scene = floor(make_scene, environment | {"lights": True, "sampling": way})
    assert isinstance(scene.compiled.world.environment, CubeEnvironment)
    assert isinstance(scene.compiled.world.sky, HemisphereSampling)
    check_mean(estimates(scene), expected, 1e-3)


@pytest.mark.parametrize("way", WAYS)
def test_paths_take_them_too(make_scene: MakeScene, way: str) -> None:
    scene = floor(make_scene, sky(way), LID)
    parts = yaml.safe_load(scene.path.read_text(encoding="utf-8"))
    found = estimates(make_scene(**parts | {"integrator": {"type": "path", "max_depth": 1}}))
    check_mean(found, 0.5, 1e-4)


@pytest.mark.parametrize("way", WAYS)
def test_directions_are_about_the_normal_and_weights_are_those_of_their_cosine(
    make_scene: MakeScene, way: str
) -> None:
    sampling = floor(make_scene, sky(way)).compiled.world.sky
    assert sampling is not None
    rng = np.random.default_rng(5)
    normal = rng.normal(size=(3, 2000))
    normal = (normal / np.linalg.norm(normal, axis=0)).astype(np.float32)
    u = rng.random((2, 2000), np.float32)
    direction, weight = sampling.sample(normal, u)
    assert weight is not None
    assert direction.dtype == weight.dtype == np.float32
    np.testing.assert_allclose(np.linalg.norm(direction, axis=0), 1, atol=1e-5)
    c = dot(normal, direction).astype(np.float64)
    assert c.min() > -1e-5
    balance = 4 * c * c / (1 + 4 * c * c)
    expected = {
        "uniform": 2 * c,
        "cosine": np.ones_like(c),
        "power": np.where(u[0] < 0.5, 2 * (1 - balance) * 2 * c, 2 * balance),
    }[way]
    np.testing.assert_allclose(weight, expected, atol=2e-5)


@pytest.mark.parametrize("way", WAYS)
def test_the_ends_of_the_numbers_are_no_trouble(make_scene: MakeScene, way: str) -> None:
    sampling = floor(make_scene, sky(way)).compiled.world.sky
    assert sampling is not None
    ends = np.array([0, 0.5, np.nextafter(np.float32(1), np.float32(0))], np.float32)
    u = np.stack(np.meshgrid(ends, ends)).reshape(2, -1)
    normal = np.repeat(np.array([[0], [0], [-1]], np.float32), u.shape[1], axis=1)
    for numbers in (u, u[:, :0], u[:, :1]):
        direction, weight = sampling.sample(normal[:, : numbers.shape[1]], numbers)
        assert weight is not None
        assert np.isfinite(direction).all()
        assert np.isfinite(weight).all()
        assert (weight >= 0).all()
        assert direction.shape == (3, numbers.shape[1])


@pytest.mark.parametrize("way", WAYS)
def test_it_says_which_functions_are_called(make_scene: MakeScene, way: str) -> None:
    scene = floor(make_scene, sky(way))
    effects = render(scene, spp=1).receipt.effects
    called = {name for name in effects["called"] if name.startswith("importance_sampling.")}
    assert called == {f"importance_sampling.{name}" for name in CALLS[way]}
    assert "importance_sampling" not in effects["skipped"]


@pytest.mark.parametrize(
    "environment",
    [sky("automatic"), sky("cosine", lights=False), sky("cosine", radiance=0)],
    ids=["automatic", "lights nothing", "black"],
)
def test_where_no_direction_is_chosen_the_module_is_not_imported(
    make_scene: MakeScene, environment: dict[str, Any]
) -> None:
    scene = floor(make_scene, environment)
    effects = render(scene, spp=1).receipt.effects
    assert "directions towards an environment" in effects["skipped"]["importance_sampling"]
    assert "importance_sampling" not in scene.effects.imported
    assert not isinstance(scene.compiled.world.environment, CubeEnvironment)
    assert not isinstance(scene.compiled.world.sky, HemisphereSampling)


def test_without_diffuse_surfaces_the_module_is_not_imported(make_scene: MakeScene) -> None:
    scene = make_scene(
        environment=sky("cosine"),
        materials={"steel": {"color": 0, "mirror": 1}},
        objects=[FLOOR | {"material": "steel"}],
    )
    render(scene, spp=1)
    assert "importance_sampling" not in scene.effects.imported


def test_a_wrong_density_shows_in_the_brightness(make_scene: MakeScene, tmp_path: Path) -> None:
    for name in ("supersampling", "importance_sampling"):
        text = (PROJECT / "solutions" / f"{name}.py").read_text(encoding="utf-8")
        (tmp_path / f"{name}.py").write_text(text, encoding="utf-8")
    with (tmp_path / "importance_sampling.py").open("a", encoding="utf-8") as file:
        file.write(
            "\ndef cosine_hemisphere_pdf(cos):\n    return cos * cos.dtype.type(0.5 / np.pi)\n"
        )
    scene = floor(make_scene, sky("cosine"))
    found = estimates(load_scene(scene.path, effects=tmp_path))
    assert found.mean() == pytest.approx(2, rel=1e-4)


def test_other_values_are_refused(make_scene: MakeScene) -> None:
    with pytest.raises(SceneError, match=r"environment\.sampling.*power"):
        floor(make_scene, sky("lobe"))
    with pytest.raises(SceneError, match=r"environment\.lights is 3: expected true or false"):
        floor(make_scene, sky("cosine", lights=3))


def test_the_scene_is_less_noisy_than_its_twin() -> None:
    paths = [PROJECT / "scenes" / folder / "importance_sampling.yaml" for folder in ("", "before")]
    means, noise = [], []
    for path in paths:
        scene = load_scene(path)
        seeds = [render(scene, size=(90, 60), seed=seed, compiled=False).linear for seed in (1, 2)]
        means.append(np.mean(seeds))
        noise.append(np.std(seeds[0] - seeds[1]))
    # The means of 5400 pixels: their noise, 0.06 at most, makes 0.001 of that.
    assert means[0] == pytest.approx(means[1], abs=0.005)
    assert noise[1] > 1.5 * noise[0]
