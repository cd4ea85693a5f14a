"""What was measured of a module as the plots of the documentation: each comparison over samples and over seconds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from course.benchmarking.curves import Curve
from course.benchmarking.measuring import FULL, QUICK, Effort, Measured
from course.benchmarking.plot_data import Plot, Record, Series

STYLES = {"regular": 3, "random": 0, "jittered": 1, "sobol": 2}
"""Each sampler has the same colour and mark in all plots."""


def record(measured: Measured, effort: Effort, machine: Mapping[str, str]) -> Record:
    """The plots of a module, as data files keep them."""
    return Record(
        command(measured.module.name, effort),
        about(measured, effort),
        dict(machine),
        comparisons(measured),
    )


def about(measured: Measured, effort: Effort) -> str:
    """With what effort a module was measured."""
    width, height = measured.size
    seeds = "1 seed" if effort.seeds == 1 else f"{effort.seeds} seeds"
    return f"{width} x {height} pixels, {seeds}"


def command(module: str, effort: Effort) -> str:
    """The line that measures a module and writes it into the documentation."""
    words = ["course bench", module, "--write-docs"]
    words += ["--quick"] if effort.name == QUICK.name else []
    usual = QUICK if effort.name == QUICK.name else FULL
    words += [f"--height {effort.height}"] if effort.height != usual.height else []
    return " ".join(words)


def comparisons(measured: Measured) -> tuple[Plot, ...]:
    """A plot for each comparison of which something was measured."""
    return tuple(
        _plot(group, title, measured.group(group))
        for group, title in measured.module.groups.items()
        if measured.group(group)
    )


def _plot(group: str, title: str, curves: Sequence[Curve]) -> Plot:
    points = any(curve.estimator.points > 1 for curve in curves)
    axes = {
        "samples": "shadow rays for each pixel" if points else "samples for each pixel",
        "seconds": "seconds",
    }
    series = tuple(_series(group, number, curve) for number, curve in enumerate(curves))
    floor = max(curve.reference.error for curve in curves)
    return Plot(group, title, axes, "RMSE", series, floor if floor > 0 else None)


def _series(group: str, number: int, curve: Curve) -> Series:
    samples = curve.samples * curve.estimator.points
    bias = float(curve.bias[-1])
    grid = curve.estimator.points > 1
    # The order of what ends at a floor says nothing.
    order = None if grid else curve.order
    return Series(
        curve.estimator.label(group),
        STYLES[curve.estimator.sampler] if group == "samplers" else number,
        {"samples": tuple(map(int, samples)), "seconds": tuple(curve.time.tolist())},
        tuple(curve.rmse.tolist()),
        order=None if order is None else order.value,
        limit=bias if grid and bias >= 2 * curve.reference.error else None,
    )
