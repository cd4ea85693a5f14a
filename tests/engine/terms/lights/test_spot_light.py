"""Spot lights: closed forms of the irradiance on the axis, at the two angles and between them, and of the power."""

import math
import re
from typing import Any

import numpy as np
import pytest

from course import render
from course.base.errors import SceneError
from course.engine.functions.effects import PROJECT
from course.engine.loops import embree_device
from course.engine.scene.scene import load_variant
from course.engine.terms.lights.light_choice import PowerChoice, power_of
from course.engine.terms.lights.spot_light import SpotLight
from tests.coarser import coarser
from tests.conftest import MakeScene

HEIGHT = 2.0
FLOOR = {"shape": "quad", "width": 40, "depth": 40, "material": "grey"}
SPOT = {
    "type": "spot",
    "position": [0, HEIGHT, 0],
    "direction": [0, -5, 0],
    "intensity": 10,
    "inner_angle": 20,
    "outer_angle": 40,
}


def light(inner: float, outer: float) -> SpotLight:
    """At the origin, along -z, angles in degrees."""
    axis, white = np.array([0, 0, -1], np.float32), np.ones(3, np.float32)
    angles = {"inner": math.radians(inner), "outer": math.radians(outer)}
    return SpotLight("", np.zeros(3, np.float32), white, axis=axis, **angles)


def share(angle: float, inner: float, outer: float) -> float:
    """In float64, from the definition; degrees."""
    if angle <= inner:
        return 1.0
    if angle >= outer:
        return 0.0
    cosine, low, high = (math.cos(math.radians(a)) for a in (angle, outer, inner))
    return ((cosine - low) / (high - low)) ** 4


@pytest.mark.parametrize(("inner", "outer"), [(20, 40), (0, 90), (1, 1.5), (30, 150), (0, 180)])
def test_the_share_is_that_of_its_definition(inner: float, outer: float) -> None:
    angles = np.linspace(0, 180, 721)
    ways = np.radians(angles)
    points = 3 * np.stack((np.sin(ways), 0 * ways, -np.cos(ways))).astype(np.float32)
    sample = light(inner, outer).sample(points, None)
    expected = [share(angle, inner, outer) for angle in angles]
    np.testing.assert_allclose(sample.factor * 9, expected, atol=2e-4)
    np.testing.assert_allclose(sample.to_light, -points)


@pytest.mark.parametrize(("inner", "outer"), [(0.01, 0.02), (0, 0.001), (0.1, 0.2)])
def test_narrow_cones_are_as_bright_as_wide_ones(inner: float, outer: float) -> None:
    """By the squares of the angles, which 1 - cos is in proportion to; float32 carries ways to 1e-7."""
    radius = np.radians(np.linspace(0, 1.2 * outer, 121)).astype(np.float32)
    points = np.stack((radius, 0 * radius, np.full(121, -1, np.float32)))
    low, high = np.radians([inner, outer]) ** 2
    expected = np.clip((high - radius.astype(np.float64) ** 2) / (high - low), 0, 1) ** 4
    found = light(inner, outer).sample(points, None).factor
    np.testing.assert_allclose(found, expected, atol=1e-5 / outer + 1e-4)
    assert found.max() == pytest.approx(1, abs=1e-3)


def test_a_hard_edge_is_one() -> None:
    points = np.array([[[0.999], [0], [-1]], [[1.001], [0], [-1]]], np.float32)
    for point, lit in zip(points, (True, False), strict=True):
        factor = light(45, 45).sample(point, None).factor
        expected = 1 / float((point**2).sum()) if lit else 0
        np.testing.assert_allclose(factor, expected, rtol=1e-5)


def seen(make_scene: MakeScene, lights: list[dict[str, Any]], size: int = 41, **more: Any) -> Any:
    """The floor from above, half as wide as it is away."""
    return make_scene(
        camera={"eye": [0, 8, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vertical_fov": 45},
        film={"width": size, "height": size},
        sampler={"type": "regular", "samples": 1},
        materials={"grey": {"color": 0.5}},
        objects=[FLOOR],
        lights=lights,
        **more,
    )


def radii(size: int) -> Any:
    half = 8 * math.tan(math.radians(22.5))
    x = half * (2 * (np.arange(size) + 0.5) / size - 1)
    return np.hypot(x, x[:, None])


@pytest.mark.parametrize("compiled", [False, True])
def test_a_floor_gets_the_irradiance_of_the_closed_form(
    make_scene: MakeScene, compiled: bool
) -> None:
    """I cos^3 / h^2 of a point light, times the share; half of it over pi is reflected. 10 / 4 on the axis."""
    if compiled and not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    picture = render(seen(make_scene, [SPOT]), compiled=compiled).linear[..., 1]
    angle = np.degrees(np.arctan(radii(41) / HEIGHT))
    irradiance = 10 / HEIGHT**2 * np.cos(np.radians(angle)) ** 3
    shares = np.vectorize(share)(angle, 20, 40)
    np.testing.assert_allclose(picture, 0.5 / math.pi * irradiance * shares, rtol=1e-3, atol=1e-6)
    assert picture[20, 20] == pytest.approx(0.5 / math.pi * 10 / 4, rel=1e-4)


def test_both_engines_agree(make_scene: MakeScene) -> None:
    if not embree_device.available():
        pytest.skip("Numba is not installed (pip install .[fast])")
    scene = seen(make_scene, [SPOT])
    pictures = [render(scene, compiled=each).linear for each in (False, True)]
    # Rounding of a cosine, which depends on the processor, is large beside the fourth power of a small difference.
    np.testing.assert_allclose(*pictures, rtol=1e-5, atol=1e-6)
    assert pictures[0].max() > 0.1


def test_it_sends_out_its_intensity_over_its_solid_angle() -> None:
    """The integral of the share over the sphere, by the midpoint rule; 4 for all directions."""
    for inner, outer in [(20, 40), (0, 90), (60, 60), (180, 180)]:
        ways = (np.arange(200_000) + 0.5) * math.pi / 200_000
        shares = np.clip(
            (np.cos(ways) - math.cos(math.radians(outer)))
            / max(math.cos(math.radians(inner)) - math.cos(math.radians(outer)), 1e-12),
            0,
            1,
        )
        solid = 2 * math.pi * (shares**4 * np.sin(ways)).mean() * math.pi
        assert power_of(light(inner, outer)) == pytest.approx(solid / math.pi, rel=1e-4)


@pytest.mark.parametrize("sampling", ["power", "uniform", "tree"])
def test_a_choice_among_spots_and_points_has_the_mean_of_all(
    make_scene: MakeScene, sampling: str
) -> None:
    """Over 16 seeds of 64 samples; 8 standard errors of a mean, estimated from them: 1 in a million by Student."""
    point = {"type": "point", "position": [1, 2, 1], "intensity": 3}
    wide = SPOT | {"position": [1, 2, 0], "outer_angle": 70, "intensity": 20}
    lights = [SPOT, point, wide, SPOT | {"direction": [-1, -1, 0]}]
    all_of_them = render(seen(make_scene, lights, 9), compiled=False).linear[..., 0]
    chosen = seen(make_scene, lights, 9, integrator={"light_sampling": sampling})
    found = [
        render(chosen, compiled=False, spp=64, sampler="random", seed=seed).linear[..., 0].mean()
        for seed in range(16)
    ]
    error = np.std(found, ddof=1) / 4
    reference = render(seen(make_scene, lights, 9), compiled=False, spp=4096, sampler="random")
    assert abs(np.mean(found) - reference.linear[..., 0].mean()) < 8 * error
    assert all_of_them.max() > 0


def test_spots_are_no_points_to_a_choice() -> None:
    choice = PowerChoice((light(10, 20), light(10, 30)))
    p = choice.probabilities
    assert p[1] > p[0]


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"direction": [0, 0, 0]}, r"lights\[0\]\.direction .* a vector that is not zero"),
        ({"inner_angle": 50}, r"outer_angle is 40: expected an angle of at least inner_angle, 50"),
        ({"outer_angle": 200}, "outer_angle"),
        ({"inner_angle": -1}, "inner_angle"),
    ],
)
def test_what_is_wrong_is_named(make_scene: MakeScene, changed: Any, told: str) -> None:
    with pytest.raises(SceneError) as error:
        seen(make_scene, [SPOT | changed])
    assert re.search(told, str(error.value)), error.value


def test_the_stage_mixes_its_colours() -> None:
    stage = PROJECT / "scenes" / "gallery" / "stage.yaml"
    picture = render(load_variant(stage, coarser(stage)), spp=4, size=(120, 80)).linear
    assert picture.max(axis=(0, 1)).min() > 0.3
