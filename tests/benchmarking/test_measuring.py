"""Measurements: rendered in turn, of the right size, with errors and biases that are what they are called."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import Picture, render
from course.benchmarking import measuring
from course.benchmarking.errors import dissimilarity, relative_mse, rmse
from course.benchmarking.estimators import Estimator, Module
from course.benchmarking.measuring import Effort, Measured, measure
from course.benchmarking.references import reference
from course.engine.loops.embree_device import available
from course.engine.scene.scene import load_variant

SQUARE = {"type": "rectangle", "corner": [0.6, 3, 0.6], "edge_u": [0, 0, 0.8]}
SQUARE |= {"edge_v": [0.8, 0, 0], "intensity": 30}
EFFORT = Effort("tiny", 16, (1, 4, 16), 3, 256)
ESTIMATORS = (
    Estimator("", "random", "sphere", ("samplers",)),
    Estimator("", "sobol", "sphere", ("samplers",)),
    Estimator(
        "grid 2 x 2",
        "sobol",
        "square",
        ("lights",),
        {("lights", 0): {**SQUARE, "samples": "grid 2"}},
        {("lights", 0): SQUARE},
        points=4,
        biased=True,
    ),
)


@pytest.fixture
def module(penumbra: Path) -> Module:
    return Module("soft_shadows", penumbra, {"samplers": "a", "lights": "b"}, ESTIMATORS)


def run(module: Module, effort: Effort = EFFORT, **options: Any) -> Measured:
    folder = module.scene.parent / "references"
    return measure(module, module.estimators, effort, folder=folder, **options)


def test_errors_are_those_of_the_renders(module: Module) -> None:
    measured = run(module)
    assert measured.size == (24, 16)
    random, sobol, grid = measured.curves
    folder = module.scene.parent / "references"
    ideal = reference(module.scene, samples=256, size=(24, 16), folder=folder)
    for curve, sampler in ((random, "random"), (sobol, "sobol")):
        assert curve.samples.tolist() == [1, 4, 16]
        scene = load_variant(module.scene)
        linear = render(scene, spp=4, size=(24, 16), sampler=sampler, seed=2).linear
        assert curve.mse[1, 1] == pytest.approx(rmse(linear, ideal.linear) ** 2)
        assert curve.relative_mse[1, 1] == pytest.approx(relative_mse(linear, ideal.linear))
        assert curve.dissimilarity[1, 1] == pytest.approx(dissimilarity(linear, ideal.linear))
        assert curve.reference.key == ideal.key
    assert measured.references.keys() == {"sphere", "square"}
    assert grid.reference.key == measured.references["square"].key != ideal.key
    assert all((curve.seconds > 0).all() for curve in measured.curves)


def test_a_grid_takes_as_many_samples_as_its_points_allow(module: Module) -> None:
    # 4 points each: at most 4 times the last number of samples is 64 points.
    assert run(module).curves[2].samples.tolist() == [1, 4, 16]
    effort = Effort("tiny", 16, (1, 4, 16), 1, 64)
    nine = Estimator("nine", "sobol", "sphere", ("samplers",), points=9)
    folder = module.scene.parent / "references"
    (curve,) = measure(module, (nine,), effort, folder=folder).curves
    assert curve.samples.tolist() == [1, 4]


def test_estimators_take_turns(module: Module, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[tuple[int, int, str]] = []

    def noted(scene: Any, **options: Any) -> Picture:
        if "seed" in options:
            calls.append((options["seed"], options["spp"], options["sampler"]))
        assert options["compiled"] is available()
        return render(scene, **options)

    monkeypatch.setattr(measuring, "render", noted)
    run(module)
    turn = ["random", "sobol", "sobol"]
    assert calls == [
        (seed, samples, sampler) for seed in (1, 2, 3) for samples in (1, 4, 16) for sampler in turn
    ]


def test_the_share_that_is_done_grows_to_one(module: Module) -> None:
    shares: list[float] = []
    run(module, tick=shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == pytest.approx(1)


def test_the_order_of_random_samples_is_a_half(module: Module) -> None:
    # The slope over 4 points of log RMSE; its noise is measured by its own interval, of which six widths (of 1.96
    # standard errors and more) hold all but 1 in 10^9.
    effort = Effort("tiny", 16, (4, 16, 64, 256), 4, 4096)
    folder = module.scene.parent / "references"
    order = measure(module, ESTIMATORS[:1], effort, folder=folder).curves[0].order
    assert order is not None
    assert (order.first, order.last) == (4, 256)
    assert abs(order.value + 0.5) < 3 * (order.high - order.low)
    assert order.high - order.low < 0.2


def test_ctrl_c_ends_it(module: Module, monkeypatch: pytest.MonkeyPatch) -> None:
    @dataclass
    class Interrupted:
        interrupted: bool = True

    run(module)
    monkeypatch.setattr(measuring, "render", lambda *_, **__: Interrupted())
    with pytest.raises(KeyboardInterrupt):
        run(module)


@pytest.mark.parametrize("bias", [0.0, 0.05])
def test_bias_is_told_from_noise(
    module: Module, monkeypatch: pytest.MonkeyPatch, bias: float
) -> None:
    # Pictures of Gaussian noise of 0.2 around the reference plus a pattern. The mean of 8 such pictures has a variance
    # v = 0.04 / 8, its square one of 2 v^2 + 4 bias^2 v, and the estimate of v that is taken off another 2 v^2 / 7, in
    # each of 4608 values; five standard errors of their mean are missed with a chance of 6e-7.
    rng = np.random.default_rng(5)
    noise, seeds, values = 0.2, 8, 4608

    @dataclass
    class Receipt:
        wall_seconds: float = 0.01

    @dataclass
    class Fake:
        linear: Any
        receipt: Receipt
        interrupted: bool = False

    effort = Effort("tiny", 32, (4,), seeds, 512)
    folder = module.scene.parent / "references"
    size = (48, 32)
    ideal = reference(module.scene, samples=512, size=size, folder=folder)
    checker = np.where(np.indices((32, 48)).sum(axis=0) % 2, bias, -bias)[..., None]

    def fake(_scene: Any, **_options: Any) -> Fake:
        return Fake(ideal.linear + checker + rng.normal(0, noise, (32, 48, 3)), Receipt())

    monkeypatch.setattr(measuring, "render", fake)
    (curve,) = measure(module, ESTIMATORS[:1], effort, folder=folder).curves
    variance = noise**2 / seeds
    spread = 2 * variance**2 * 8 / 7 + 4 * bias**2 * variance
    error = 5 * np.sqrt(spread / values)
    # The reference's own error is taken off, though these pictures don't have it.
    assert abs(curve.bias[0] ** 2 - bias**2) < error + ideal.error**2
    assert curve.rmse[0] == pytest.approx(np.sqrt(noise**2 + bias**2), rel=0.05)


def test_what_is_written_can_be_read(module: Module) -> None:
    measured = run(module)
    data = json.loads(json.dumps(measured.to_dict(), allow_nan=False))
    assert data["size"] == [24, 16]
    assert [e["estimator"] for e in data["estimators"]] == ["random", "sobol", "grid 2 x 2 sobol"]
    for entry, curve in zip(data["estimators"], measured.curves, strict=True):
        assert entry["mse_by_seed"] == curve.mse.tolist()
        mse = np.array(entry["mse_by_seed"]).mean(axis=1)
        assert entry["rmse"] == pytest.approx(np.sqrt(mse).tolist())
        seconds = np.median(entry["seconds_by_seed"], axis=1)
        assert entry["efficiency"] == pytest.approx((1 / (mse * seconds)).tolist())
        assert entry["integral"] in data["references"]
