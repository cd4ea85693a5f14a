"""Curves that follow power laws exactly, for what is made of measurements."""

from pathlib import Path

import numpy as np

from course.benchmarking.curves import Converged, Curve
from course.benchmarking.estimators import Estimator, Module
from course.benchmarking.measuring import Measured

SAMPLES = (1, 4, 16, 64, 256)


def curve(
    name: str,
    order: float,
    *,
    scale: float = 0.1,
    seconds: float = 0.01,
    samples: tuple[int, ...] = SAMPLES,
    floor: float = 1e-5,
    bias: float = 0.0,
    points: int = 1,
) -> Curve:
    """RMSE = scale n^order, time = seconds n, with 3 equal seeds."""
    variant, _, sampler = name.rpartition(" ")
    estimator = Estimator(
        variant, sampler, "it", ("samplers",), points=points, biased=bias > 0 or points > 1
    )
    n = np.array(samples, float)
    mse = np.repeat((scale * n**order)[:, None] ** 2, 3, axis=1)
    times = np.repeat(seconds * n[:, None], 3, axis=1)
    errors = {"mse": mse, "relative_mse": 2 * mse, "dissimilarity": 3 * mse}
    reference = Converged("0123456789abcdef", floor, 2048)
    biases = np.full(len(samples), bias)
    return Curve(estimator, reference, n, seconds=times, bias=biases, **errors)


def measured(*curves: Curve) -> Measured:
    module = Module(
        "soft_shadows",
        Path("soft_shadows.yaml"),
        {"samplers": "some ways to place samples"},
        tuple(item.estimator for item in curves),
    )
    return Measured(module, (72, 48), curves)
