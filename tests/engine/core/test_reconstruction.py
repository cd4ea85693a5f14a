"""Reconstruction: what a pixel makes of its samples, through functions that may be a student's."""

import numpy as np
import pytest

from course.engine.core.film import Reconstruction
from course.engine.core.types import Functions
from course.engine.functions.effects import Effects

EFFECTS = Effects("solutions")
FUNCTIONS = Functions(
    **{name: EFFECTS.function("supersampling", name) for name in ("resolve", "gaussian_weights")}
)
RESOLVE = Functions(resolve=FUNCTIONS.resolve)


def samples(n: int = 20, s: int = 16) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(4)
    return rng.random((3, n, s), np.float32), rng.random((2, n, s), np.float32)


def test_the_box_filter_is_the_mean() -> None:
    radiance, offsets = samples()
    mean, weight = Reconstruction(RESOLVE, False, None).pixels(radiance, offsets)
    assert np.allclose(mean, radiance.astype(float).mean(axis=2), rtol=1e-6)
    assert weight == 16
    assert mean.dtype == np.float32


@pytest.mark.parametrize("sigma", [0.05, 1 / 6, 3.0])
def test_the_gaussian_filter_weighs_by_the_distance_from_the_middle(sigma: float) -> None:
    radiance, offsets = samples()
    mean, weight = Reconstruction(FUNCTIONS, False, sigma).pixels(radiance, offsets)
    squared = ((offsets.astype(float) - 0.5) ** 2).sum(axis=0)
    w = np.exp(-squared / (2 * sigma**2))
    assert np.allclose(mean, (radiance * w).sum(axis=2) / w.sum(axis=1), rtol=1e-4)
    assert np.allclose(weight, w.sum(axis=1), rtol=1e-4)


def test_a_single_sample_is_the_pixel() -> None:
    radiance, offsets = samples(s=1)
    mean, weight = Reconstruction(Functions(), True, None).pixels(radiance, offsets)
    assert np.array_equal(mean, radiance[:, :, 0])
    assert weight == 1


def test_stretches_of_samples_add_up_to_the_whole() -> None:
    radiance, offsets = samples(s=32)
    one = Reconstruction(FUNCTIONS, False, 1 / 6)
    whole, _ = one.pixels(radiance, offsets)
    halves = [one.pixels(radiance[:, :, h], offsets[:, :, h]) for h in (slice(16), slice(16, 32))]
    total = sum(weight for _, weight in halves)
    assert np.allclose(sum(mean * weight for mean, weight in halves) / total, whole, rtol=1e-5)
