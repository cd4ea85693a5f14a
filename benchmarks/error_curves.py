"""Errors of estimates of a known mean: over the number of points, with the fitted order and the time of an estimate."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from time import perf_counter

import numpy as np

from course.benchmarking.curves import ConvergenceOrder, fit_order
from course.benchmarking.plot_data import Plot, Series
from course.engine.core.types import Floats64


def median_seconds(
    ways: Mapping[str, Callable[[int, int], object]], counts: Sequence[int], rounds: int
) -> dict[str, tuple[float, ...]]:
    """Time every way with every number of samples.

    In each round all ways take their turn, so that whatever else the machine does meets them alike. The rounds of one
    number of samples come before those of the next: a small batch would else begin with caches that a large one has
    left. Before the first round each way has been called once, for what it makes only then.

    Parameters
    ----------
    ways : name -> what takes a number of samples and a round's number, from 0 on
    rounds : how often each is timed; of the times the median counts
    """
    for way in ways.values():
        way(counts[0], 0)
    seconds = {name: np.empty((len(counts), rounds)) for name in ways}
    for row, count in enumerate(counts):
        for turn in range(rounds):
            for name, way in ways.items():
                started = perf_counter()
                way(count, turn)
                seconds[name][row, turn] = perf_counter() - started
    return {name: tuple(np.median(each, axis=1).tolist()) for name, each in seconds.items()}


Estimate = Callable[[int, int], float]
"""Takes a number of points and a seed."""


@dataclass(frozen=True)
class Curve:
    """Errors of one way to estimate.

    Attributes
    ----------
    counts : numbers of points
    mse : (counts, seeds) squared errors
    seconds : (counts,) medians of one estimate
    """

    name: str
    counts: tuple[int, ...]
    mse: Floats64
    order: ConvergenceOrder
    seconds: tuple[float, ...]

    @property
    def rmse(self) -> Floats64:
        """(counts,) root-mean-square errors over the seeds."""
        return np.sqrt(self.mse.mean(axis=1))


def error_curves(
    ways: Mapping[str, Estimate], value: float, counts: tuple[int, ...], seeds: int
) -> list[Curve]:
    """Estimate a mean in several ways with each number of points and each seed.

    ``value``: of the mean.
    """
    seconds = median_seconds(ways, counts, seeds)
    curves = []
    for name, estimate in ways.items():
        # Each number of points has seeds of its own, so that the errors of a curve are independent.
        estimates = np.array(
            [
                [estimate(n, 1000 * row + seed) for seed in range(seeds)]
                for row, n in enumerate(counts)
            ]
        )
        mse = (estimates - value) ** 2
        order = fit_order(np.array(counts, np.float64), mse)
        assert order is not None
        curves.append(Curve(name, counts, mse, order, seconds[name]))
    return curves


def error_plot(name: str, title: str, curves: Iterable[Curve], styles: Iterable[int]) -> Plot:
    """Errors over points and over seconds; a style is a series' colour and mark."""
    series = tuple(
        Series(
            curve.name,
            style,
            {"samples": curve.counts, "seconds": curve.seconds},
            tuple(curve.rmse.tolist()),
            order=curve.order.value,
        )
        for style, curve in zip(styles, curves, strict=False)
    )
    return Plot(name, title, {"samples": "points", "seconds": "seconds"}, "RMSE", series)
