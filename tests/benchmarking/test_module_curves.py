"""The curves that the modules' own benchmarks keep for the documentation: small runs, and what must come out."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from benchmarks import (
    adaptive_sampling,
    bounding_volumes,
    error_curves,
    importance_sampling,
    path_tracing,
    quasi_monte_carlo,
    radiosity,
    sampling,
)
from course.benchmarking.measuring import Effort
from course.benchmarking.plot_data import Plot, comparisons


def test_a_warp_carries_evenness_over_and_rejection_does_not() -> None:
    plot = sampling.errors(quasi_monte_carlo.COUNTS[:4], 32)
    orders = {series.name: series.order for series in plot.series}
    # The order of 32 seeds over a factor of 64 scatters by 0.04; the seeds are fixed.
    for name in ("rejection, random", "polar, random"):
        assert orders[name] == pytest.approx(-0.5, abs=0.15)
    assert orders["polar, jittered"] < -0.85
    assert orders["polar, Sobol"] < -1.1
    assert _along_both_axes(plot)
    # x^2 has the variance 1/16 over the unit disk: its mean square 1/8 less 1/16.
    for series in plot.series[:2]:
        assert series.y[0] == pytest.approx(math.sqrt(1 / 16 / 16), rel=0.4)


def _along_both_axes(plot: Plot) -> bool:
    """Whether every line has a count and a time for each error."""
    return list(plot.axes) == ["samples", "seconds"] and all(
        list(series.x) == ["samples", "seconds"]
        and len(series.x["samples"]) == len(series.x["seconds"]) == len(series.y)
        and min(series.x["seconds"]) > 0
        for series in plot.series
    )


def test_point_sets_are_drawn_over_points_and_seconds() -> None:
    integral = quasi_monte_carlo.INTEGRALS[0]
    curves = quasi_monte_carlo.measure(integral, quasi_monte_carlo.COUNTS[:3], 4)
    plot = quasi_monte_carlo.plot(integral, curves)
    assert _along_both_axes(plot)
    assert [series.x["seconds"] for series in plot.series] == [curve.seconds for curve in curves]


def test_times_are_medians_of_rounds_in_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = [0.0]
    calls = []

    def way(name: str, seconds: float) -> Callable[[int, int], None]:
        def work(count: int, turn: int) -> None:
            calls.append((name, count, turn))
            # One round in five meets whatever else the machine does.
            clock[0] += seconds * count + 100 * (turn == 3)

        return work

    monkeypatch.setattr(error_curves, "perf_counter", lambda: clock[0])
    ways = {"one": way("one", 1.0), "two": way("two", 2.0)}
    found = error_curves.median_seconds(ways, (4, 16), 5)
    assert found == {"one": (4.0, 16.0), "two": (8.0, 32.0)}
    # Each once for what it makes only then, and then in turn.
    assert calls[:6] == [("one", 4, 0), ("two", 4, 0)] * 2 + [("one", 4, 1), ("two", 4, 1)]
    assert calls[-2:] == [("one", 16, 4), ("two", 16, 4)]
    assert len(calls) == 2 + 5 * 4


def test_every_sampler_and_every_roulette_is_measured(tmp_path: Path) -> None:
    effort = Effort("tiny", 11, (1, 4, 16), 2, 64)
    samplers, roulette = comparisons(path_tracing.curves(effort, tmp_path))
    assert [series.name for series in samplers.series] == ["regular", "random", "jittered", "Sobol"]
    assert [series.name for series in roulette.series] == list(path_tracing.ROULETTE)
    for plot in (samplers, roulette):
        assert plot.floor is not None
        for series in plot.series:
            assert series.x["samples"] == (1, 4, 16)
            assert series.y[0] > series.y[-1] > 0
    # Roulette is at work: what is drawn differs, and so do the errors.
    assert len({series.y for series in roulette.series}) == len(path_tracing.ROULETTE)


def test_predicted_errors_are_drawn_beside_the_measured_ones() -> None:
    ways = importance_sampling.HIGHLIGHT
    found = importance_sampling.measure(ways, 16, 256)
    plot = importance_sampling.plot(ways, found)
    predicted = {series.name: series for series in plot.series if series.predicted}
    # The lobe alone has no finite variance.
    assert set(predicted) == {"uniform", "cosine", "cosine and lobe"}
    for series in predicted.values():
        assert np.diff(np.log(series.y)) == pytest.approx(np.full(len(series.y) - 1, -math.log(2)))
    measured = [series for series in plot.series if not series.predicted]
    assert _along_both_axes(plot)
    # What was predicted for a number of samples stands at the seconds that as many took.
    for series in measured:
        assert series.name not in predicted or predicted[series.name].x == series.x
    assert [series.name for series in measured] == [way.name for way in found]
    assert all(series.y == tuple(way.curve) for series, way in zip(measured, found, strict=True))


def test_a_divided_picture_is_a_mark_for_each_depth() -> None:
    point = adaptive_sampling.Point
    even = [point(1.0, 0.4, 0.5), point(4.0, 0.2, 1.5)]
    divisions = [
        adaptive_sampling.Division(
            threshold, depth, point(depth + 1.5, 0.1, depth + 2.0), 0.0, 1.0, 1.0
        )
        for threshold in (0.4, 0.1)
        for depth in (0, 1, 2)
    ]
    found = adaptive_sampling.Measured(even, even, divisions)
    plot = adaptive_sampling.plot("wires", "with its wires", found)
    assert _along_both_axes(plot)
    assert [series.x["seconds"] for series in plot.series] == [(0.5, 1.5)] * 2 + [(2, 3, 4)] * 2
    assert {series.name: series.x["samples"] for series in plot.series} == {
        "k x k grid": (1.0, 4.0),
        "Sobol": (1.0, 4.0),
        "divided over 0.4": (1.5, 2.5, 3.5),
        "divided over 0.1": (1.5, 2.5, 3.5),
    }


def test_brute_force_tests_every_triangle() -> None:
    walk = bounding_volumes.Walk
    walks = [walk(2048, 4, 1023, 42.5, 14.0), walk(32768, 4, 16383, 57.0, 12.0)]
    plot = bounding_volumes.plot(walks)
    assert {series.name: series.y for series in plot.series} == {
        "brute force": (2048, 32768),
        "boxes": (42.5, 57.0),
        "triangles": (14.0, 12.0),
    }
    first, _ = bounding_volumes.table(walks).rows
    assert first == ("2,048", "4", "1,023", "42.5", "14.0", "2,048")


def test_radiosity_is_drawn_over_shots_and_seconds() -> None:
    row = {"shots": 1, "seconds": 0.5, "missing": 0.4, "missing_with_ambient": 0.3, "bound": 2.0}
    plot = radiosity.plot([row, {**row, "shots": 32, "seconds": 4.0}])
    assert not plot.slope
    for series in plot.series:
        assert series.x == {"shots": (1, 32), "seconds": (0.5, 4.0)}
    assert {series.name: series.y[0] for series in plot.series} == {
        "bound": 2.0,
        "light missing": 0.4,
        "with the ambient term": 0.3,
    }
