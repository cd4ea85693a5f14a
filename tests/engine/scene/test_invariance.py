"""The same picture in nanometres and in parsecs, at the origin and far away.

The bound. Scaling multiplies every coordinate by one factor in float64 and compiling divides by it again, which
changes a coordinate by at most a few parts in 2^53. It survives the rounding to float32 in one case of 2^28, so most
pictures are equal bit for bit.

Moving a scene by 10^8 of its sizes rounds its coordinates to 10^8 2^-53 = 1.1e-8 sizes, up to 4.4e-8 of the half extent
for three roundings: less than a unit of float32 (2^-24 = 6e-8). So corners may move by one such unit, and brightness by
some units times the steepness of the scene: a light at a fifth of the half extent, a sphere of that radius that bends
what is seen in it, each tenfold, make 1e-7 into 1e-5. We allow 2e-4 of a pixel's own brightness plus 2e-6 of white; a
sample that falls on the other side of an edge changes its pixel by more, and would happen in about one picture of 100.
"""

from typing import Any

import numpy as np
import pytest

from course import render
from tests.engine.conftest import EveryStage
from tests.lengths import fewer

SIZE = 6.0


def exceeding(a: np.ndarray, b: np.ndarray) -> int:
    """Pixels that differ by more than the bound."""
    assert np.isfinite(b).all()
    difference = np.abs(a.astype(float) - b)
    return int((difference > 2e-4 * np.abs(a) + 2e-6).any(axis=2).sum())


@pytest.mark.parametrize("power", [-100, -10, 1, 10, 100])
def test_a_scene_scaled_by_a_power_of_two_is_the_same_bit_for_bit(
    every_stage: EveryStage, power: int
) -> None:
    expected = render(every_stage(), spp=4).linear
    assert render(every_stage(2.0**power), spp=4).linear.tobytes() == expected.tobytes()


@pytest.mark.parametrize("k", [1e-30, 1e-20, 1e-9, 1e-3, 1e3, 1e9, 1e20, 1e30])
def test_a_scaled_scene_gives_the_same_picture(every_stage: EveryStage, k: float) -> None:
    expected, scaled = render(every_stage(), spp=4).linear, render(every_stage(k), spp=4).linear
    # Measured: equal bit for bit for every one of these factors.
    assert np.allclose(scaled, expected, rtol=1e-5, atol=1e-7)


@fewer
@pytest.mark.parametrize(
    "direction", [(1, 0, 0), (0, -1, 0), (0, 0, 1), (1, 1, -1), (0.123, 0.7, 0.31)]
)
@pytest.mark.parametrize("k", [1.0, 1e-30, 1e30])
def test_a_scene_far_away_gives_the_same_picture(
    every_stage: EveryStage, direction: tuple[float, ...], k: float
) -> None:
    expected = render(every_stage(), spp=4).linear
    away = [1e8 * SIZE * k * c for c in direction]
    # Measured: the largest difference is 2e-5 of a pixel, a tenth of the bound; no pixel exceeds it.
    assert exceeding(expected, render(every_stage(k, away), spp=4).linear) <= 1


def test_the_bound_would_notice_a_picture_that_is_a_little_off(every_stage: EveryStage) -> None:
    expected = render(every_stage(), spp=4).linear
    camera = {"eye": [0.3, 1.8, 4.0001], "look_at": [0, 0.6, 0], "vertical_fov": 45}
    assert exceeding(expected, render(every_stage(camera=camera), spp=4).linear) >= 10


def test_brightness_scales_with_the_lights(every_stage: EveryStage) -> None:
    black: dict[str, Any] = {"environment": {"type": "constant", "radiance": 0}}
    plain = {"integrator": {"max_depth": 3, "cutoff": 0}}
    light = {"type": "sphere", "center": [0, 2, 2], "radius": 0.3}
    one = render(every_stage(lights=[light | {"intensity": 1}], **black, **plain)).linear
    many = render(every_stage(lights=[light | {"intensity": 2.0**40}], **black, **plain)).linear
    assert np.array_equal(many, one * np.float32(2.0**40))
    assert one.max() > 0
