"""Perlin's noise: zero at whole points, bounded, smooth, and the same wherever the object goes."""

from typing import Any

import numpy as np
import pytest

from course import render
from course.base.errors import SceneError
from course.engine.terms.surfaces.perlin import GRADIENTS, PERIOD, noise
from tests.conftest import MakeScene

RNG = np.random.default_rng(3)


def test_whole_points_are_zero() -> None:
    whole = RNG.integers(-300, 300, (3, 2000)).astype(np.float32)
    assert np.array_equal(noise(whole), np.zeros(2000, np.float32))


def test_it_is_bounded_and_of_mean_zero() -> None:
    """A million points; cells are independent, so the mean's standard error is below 0.25 / sqrt(32 768)."""
    values = noise(RNG.uniform(-16, 16, (3, 1_000_000)).astype(np.float32))
    assert np.abs(values).max() <= 1
    assert values.max() > 0.7
    assert values.min() < -0.7
    assert abs(values.mean()) < 6 * 0.25 / np.sqrt(32_768)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_value_and_slope_go_on_across_the_faces_of_cells(axis: int) -> None:
    """One-sided differences over 1/512 on both sides of a face differ by the curvature times that."""
    points = RNG.uniform(0, 8, (3, 4000)).astype(np.float32)
    points[axis] = np.round(points[axis])
    step = np.zeros((3, 1), np.float32)
    step[axis] = 1 / 512
    here, left, right = noise(points), noise(points - step), noise(points + step)
    assert np.abs(right - here).max() < 3 / 512
    assert np.abs((right - here) - (here - left)).max() * 512 < 0.05


def test_slopes_at_whole_points_are_the_gradients() -> None:
    points = RNG.integers(0, 50, (3, 500)).astype(np.float32)
    slopes = []
    for axis in range(3):
        step = np.zeros((3, 1), np.float32)
        step[axis] = 1 / 256
        slopes.append((noise(points + step) - noise(points - step)) * 128)
    known = GRADIENTS[:, :, None]
    apart = np.abs(known - np.stack(slopes)).max(axis=1)
    assert apart.min(axis=0).max() < 0.01
    assert sorted(set(apart.argmin(axis=0).tolist())) == list(range(12))


def test_it_repeats_after_its_period_and_not_before() -> None:
    points = RNG.uniform(0, 4, (3, 1000)).astype(np.float32).round(2)
    shifted = points + np.float32(PERIOD)
    assert np.abs(noise(shifted) - noise(points)).max() < 1e-3
    assert np.abs(noise(points + np.float32(PERIOD // 2)) - noise(points)).max() > 0.3


def pixel(make_scene: MakeScene, point: Any, steps: Any = (), **noisy: Any) -> float:
    """The ambient light on a quad's point (x, z), of an object that has been moved."""
    steps = list(steps)
    moved = np.array([point[0], 0, point[1]], float)
    for step in steps:
        moved = moved + step["translate"]
    scene = make_scene(
        camera={
            "eye": (moved + np.array([0, 2, 0])).tolist(),
            "look_at": moved.tolist(),
            "up": [0, 0, -1],
            "vertical_fov": 1e-3,
        },
        film={"width": 1, "height": 1},
        materials={"m": {"color": 0.5, "noise": noisy}},
        objects=[{"shape": "quad", "width": 4, "depth": 4, "material": "m", "transform": steps}],
        lights=[{"type": "ambient", "radiance": 1}],
    )
    return float(render(scene, compiled=False).linear[0, 0, 0])


@pytest.mark.parametrize("steps", [[], [{"translate": [3, 1, -2]}]])
@pytest.mark.parametrize("conversion", ["linear", "absolute"])
def test_a_surface_has_the_noise_of_its_own_place(
    make_scene: MakeScene, conversion: str, steps: Any
) -> None:
    for x, z in ((0.31, 0.77), (-1.2, 0.4), (1.11, -1.63)):
        value = float(noise(np.array([[x], [0], [z]], np.float32) * np.float32(3))[0])
        value = abs(value) if conversion == "absolute" else (value + 1) / 2
        seen = pixel(make_scene, (x, z), steps, scale=3, conversion=conversion)
        assert seen == pytest.approx(0.5 * value, abs=2e-4)


def test_a_material_has_a_texture_or_noise(make_scene: MakeScene) -> None:
    with pytest.raises(SceneError, match="both texture and noise are given"):
        make_scene(materials={"m": {"noise": {}, "texture": {"image": "a.png"}}})
