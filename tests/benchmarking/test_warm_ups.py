"""The lectures' figures on sampling, importance sampling and quasi-Monte Carlo: closed forms, small runs, files."""

import math
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from benchmarks import importance_sampling, quasi_monte_carlo, sampling
from benchmarks.__main__ import MEASURES
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.plots import STYLE, draw, write, write_plots
from tests.lengths import fewer

pytest.importorskip("matplotlib")


def words(path: Path) -> set[str]:
    tree = ET.parse(path)
    return {"".join(node.itertext()) for node in tree.iter("{http://www.w3.org/2000/svg}text")}


def test_each_has_its_command() -> None:
    assert {"sampling", "adaptive_sampling", "importance_sampling", "quasi_monte_carlo"} <= {
        *MEASURES
    }


# ---------------------------------------------------------------- sampling


def test_acceptance_is_counted_on_what_the_functions_drew() -> None:
    for rate in sampling.acceptances(400_000):
        # By 5 standard errors in one of 1.7 million runs; the seed is fixed.
        assert abs(rate.off) < 5
        assert rate.inside >= 400_000
        assert rate.error == pytest.approx(
            math.sqrt(rate.expected * (1 - rate.expected) / rate.candidates)
        )
    told = sampling.table(sampling.acceptances(1000)).plain()
    assert "π/4 = 0.78540" in told
    assert "π/6 = 0.52360" in told


@pytest.mark.parametrize(
    "panel", [panel for row in sampling.PANELS for panel in row], ids=lambda p: p.title + p.shape
)
def test_a_point_set_has_its_share_in_the_middle(panel: sampling.Panel) -> None:
    n = 100_000
    points = panel.make(n, np.random.default_rng(4))
    assert np.linalg.norm(points, axis=0).max() < 1 + 1e-5
    error = math.sqrt(panel.inner * (1 - panel.inner) / n)
    # 9 panels, each off by 5 standard errors in one of 1.7 million runs; the seed is fixed.
    assert abs(sampling.inner_share(panel.shape, points) - panel.inner) < 5 * error


def test_the_point_sets_are_drawn(tmp_path: Path) -> None:
    told = words(sampling.draw(tmp_path / "points.svg", 20))
    assert {"by rejection", "polar", "mistake: without the square root"} <= told


# ---------------------------------------------------------------- importance sampling


def test_variances_of_the_cube_are_those_of_the_page() -> None:
    predicted = importance_sampling.predicted(importance_sampling.CUBE)
    assert predicted["uniform"] == pytest.approx(math.pi**2 * 9 / 28)
    assert predicted["cosine"] == pytest.approx(math.pi**2 / 12)
    assert predicted["Phong lobe"] == pytest.approx(math.pi**2 / 60)


def test_the_power_heuristic_s_variance_in_closed_form() -> None:
    # cos^3 by p = cos / pi and q = 3 cos^2 / (2 pi): with k = (q / p)^2 / cos^2 = 9/4 the weights are 1 / (1 + k cos^2)
    # and k cos^2 / (1 + k cos^2).
    k = 9 / 4
    first = math.pi**2 / k**3 * ((1 + k) - 2 * math.log(1 + k) - 1 / (1 + k))
    u = math.sqrt(k)
    second = 4 * math.pi**2 / 3 * k**2 / k**4.5
    second *= u**5 / 5 - 2 * u**3 / 3 + 3 * u - 3.5 * math.atan(u) + u / (2 * (1 + u**2))
    mean = math.pi / k**2 * (k - math.log(1 + k))
    expected = 2 * (first - mean**2 + second - (math.pi / 2 - mean) ** 2)
    assert importance_sampling.combined(importance_sampling.CUBE) == pytest.approx(expected)


def test_a_lobe_that_is_too_narrow_has_no_finite_variance() -> None:
    predicted = importance_sampling.predicted(importance_sampling.HIGHLIGHT)
    assert predicted["Phong lobe"] == math.inf
    assert predicted["cosine and lobe"] < predicted["cosine"] / 4


@pytest.mark.parametrize("integrand", [importance_sampling.CUBE, importance_sampling.HIGHLIGHT])
def test_measured_variances_are_those_predicted(
    integrand: importance_sampling.Integrand, tmp_path: Path
) -> None:
    found = importance_sampling.measure(integrand, 48, 4096)
    finite = [way for way in found if math.isfinite(way.predicted)]
    assert len(finite) == (4 if integrand is importance_sampling.CUBE else 3)
    for way in finite:
        # With 47 degrees of freedom one is off by 6 in one of 3 million runs; the seed is fixed.
        assert abs(way.off) < 6
        assert way.error < 0.05 * way.predicted
        assert way.curve[0] > 10 * way.curve[-1]
    path = importance_sampling.draw(integrand, found, tmp_path / "figure.svg")
    told = words(path)
    assert {f"uniform  {found[0].predicted:.2f}", "RMSE", "samples"} <= told
    assert len(importance_sampling.table(integrand, found).rows) == 4


# ---------------------------------------------------------------- quasi-Monte Carlo


@pytest.mark.parametrize("integral", quasi_monte_carlo.INTEGRALS, ids=lambda one: one.name)
def test_an_integral_has_the_value_that_it_is_said_to_have(
    integral: quasi_monte_carlo.Integral,
) -> None:
    # A product rule of midpoints, which is off by pi^2 / 24 / 12^2 a dimension for the sines.
    side = 12 if integral.dims == 6 else 400
    line = (np.arange(side) + 0.5) / side
    points = np.stack([axis.ravel() for axis in np.meshgrid(*[line] * integral.dims)])
    value = float(integral.f(points).mean())
    assert value == pytest.approx(integral.value, rel=0.02 if integral.dims == 6 else 1e-3)


@fewer
@pytest.mark.parametrize("dims", [2, 6])
@pytest.mark.parametrize("name", quasi_monte_carlo.SETS)
def test_point_sets_are_uniform_over_the_seeds(name: str, dims: int) -> None:
    points = np.stack([quasi_monte_carlo.SETS[name](16, dims, seed) for seed in range(500)])
    assert points.shape == (500, dims, 16)
    assert points.min() >= 0
    assert points.max() < 1
    # Means of a set scatter by sqrt(1 / 12) at most; 12 sets of up to 6, each off by 5 in one of 1.7 million runs.
    off = (points.mean(axis=(0, 2)) - 0.5) / (math.sqrt(1 / 12) / math.sqrt(500))
    assert np.abs(off).max() < 5
    assert not (points[0] == points[1]).all()


def test_chained_patterns_stay_as_even_as_they_were() -> None:
    # Each pair is a shifted Hammersley set: its first coordinates lie 1 / n apart.
    points = quasi_monte_carlo.SETS["chained ids"](64, 6, 3)
    for row in (0, 2, 4):
        assert np.diff(np.sort(points[row])) == pytest.approx(np.full(63, 1 / 64), abs=1e-5)
    assert (np.argsort(points[0]) != np.argsort(points[2])).any()


def test_orders_are_fitted_and_drawn(tmp_path: Path) -> None:
    integral = quasi_monte_carlo.INTEGRALS[1]
    curves = quasi_monte_carlo.measure(integral, quasi_monte_carlo.COUNTS[:4], 16)
    order = {curve.name: curve.order for curve in curves}
    assert set(order) == set(quasi_monte_carlo.SETS)
    # Random points have -1/2, and stratified ones -1, for a smooth function of two numbers.
    assert order["random"].low < -0.5 < order["random"].high
    assert order["jittered"].value < -0.85
    assert order["Sobol"].value < -1.2
    plot = quasi_monte_carlo.plot(integral, curves)
    over_points, _ = write_plots("points", [plot], "16 seeds", tmp_path)
    told = words(over_points)
    assert {f"{name}  {one.value:.2f}" for name, one in order.items()} <= told
    assert {"order -1/2", "order -1", "points", "RMSE"} <= told


# ---------------------------------------------------------------- drawing


def test_names_stand_within_the_figure_and_apart(tmp_path: Path) -> None:
    from matplotlib import rc_context
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    lines = tuple(
        Series(f"line {number}", number, {"x": (1, 100)}, (1.0, 0.01)) for number in range(4)
    )
    with rc_context(STYLE):
        figure = draw(Plot("four", "title", {"x": "x"}, "y", lines), "x", "about")
        (axes,) = figure.axes
        renderer = FigureCanvasAgg(figure).get_renderer()
        boxes = [text.get_window_extent(renderer) for text in axes.texts if "line" in text._text]
        assert len(boxes) == 4
        for box in boxes:
            assert 0 <= box.y0 < box.y1 <= figure.bbox.y1
            assert box.x1 <= figure.bbox.x1
        heights = sorted(box.y0 for box in boxes)
        assert all(b - a > 0.9 * boxes[0].height for a, b in pairwise(heights))
        one = write(figure, tmp_path / "one.svg").read_bytes()
        assert write(figure, tmp_path / "two.svg").read_bytes() == one
