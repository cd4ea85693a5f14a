"""Plots for lectures: error over samples and error over time, one figure for each comparison.

matplotlib is an extra, imported when a plot is asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from course.benchmarking.convergence_data import STYLES
from course.benchmarking.curves import Curve
from course.benchmarking.measuring import Measured
from course.benchmarking.tables import digits
from course.core.types import Floats64
from course.errors import CourseError
from course.imaging.atomic import replacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLORS = ("#D55E00", "#0072B2", "#00805D", "#333333", "#AA4D80", "#8A6A00")
"""Told apart by people who don't see red or green, as those of Okabe & Ito (2008), and dark enough to be read."""

MARKERS = ("o", "s", "^", "v", "D", "P")
INK, SOFT = "#222222", "#767676"

STYLE: dict[str, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans", "Verdana", "Arial"],
    "font.size": 15,
    "text.color": INK,
    "axes.edgecolor": SOFT,
    "axes.labelcolor": INK,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "xtick.color": INK,
    "ytick.color": INK,
    "svg.fonttype": "none",
    "svg.hashsalt": "penumbra",
}


def check_matplotlib() -> None:
    """Find out before the work whether plots can be drawn.

    Raises
    ------
    CourseError
        matplotlib is not installed.
    """
    if find_spec("matplotlib") is None:
        raise CourseError(
            "plots need matplotlib, which is not installed: python -m pip install -e '.[bench]'"
        )


def write_plots(measured: Measured, folder: Path, note: str) -> list[Path]:
    """Draw every comparison of a module, over samples and over seconds.

    Parameters
    ----------
    folder : of the SVG files, MODULE_GROUP_samples.svg and MODULE_GROUP_seconds.svg; it is there
    note : stands small below the figures that show times

    Returns
    -------
    list of Path
        The files. A comparison of which nothing was measured has none.

    Raises
    ------
    CourseError, OutputError
        matplotlib is not installed, or a file can't be written.
    """
    check_matplotlib()
    from matplotlib import rc_context

    written = []
    for group in measured.module.groups:
        curves = measured.group(group)
        if not curves:
            continue
        for kind, draw in (("samples", error_over_samples), ("seconds", error_over_seconds)):
            path = folder / f"{measured.module.name}_{group}_{kind}.svg"
            with rc_context(STYLE):
                figure = draw(measured, group, note)
                with replacing(path) as temporary:
                    figure.savefig(temporary, format="svg", metadata={"Date": None})
            written.append(path)
    return written


def error_over_samples(measured: Measured, group: str, _note: str) -> Figure:
    """RMSE over samples, with the fitted orders and the slopes of two to compare with; of grids of lights the bias."""
    curves = measured.group(group)
    points = any(curve.estimator.points > 1 for curve in curves)
    figure, axes = _figure(measured, group, curves)
    horizontal = [curve.samples * curve.estimator.points for curve in curves]
    axes.set_xlabel("shadow rays for each pixel" if points else "samples for each pixel")
    ends = _draw(axes, group, curves, horizontal)
    _powers_of_four(axes, horizontal)
    if not points:
        _slopes(axes, horizontal[0], curves)
    for curve, x, (_, _, color) in zip(curves, horizontal, ends, strict=True):
        _show_floor(axes, curve, x, color)
    _label(axes, ends, [f"{curve.estimator.label(group)}  {_slope(curve)}" for curve in curves])
    return figure


def _show_floor(axes: Axes, curve: Curve, x: Floats64, color: str) -> None:
    """A dotted line at the error that more samples leave to a grid of point lights, if it can be told from noise."""
    bias = float(curve.bias[-1])
    if curve.estimator.points == 1 or bias < 2 * curve.reference.error:
        return
    axes.hlines(bias, x[0], x[-1], colors=color, linestyles="dotted")
    axes.annotate(
        f"bias {digits(bias)}",
        (float(x[0]), bias),
        xytext=(2, 3),
        textcoords="offset points",
        fontsize=11,
        color=color,
    )


def _slope(curve: Curve) -> str:
    """The fitted order; what ends at a floor has none."""
    order = None if curve.estimator.points > 1 else curve.order
    return "" if order is None else f"{order.value:.2f}"


def error_over_seconds(measured: Measured, group: str, note: str) -> Figure:
    """RMSE over the median time of a render."""
    curves = measured.group(group)
    figure, axes = _figure(measured, group, curves)
    axes.set_xlabel("seconds")
    ends = _draw(axes, group, curves, [curve.time for curve in curves])
    axes.xaxis.set_major_formatter(_plain_numbers())
    axes.xaxis.set_minor_formatter(_nothing())
    low, high = axes.get_xlim()
    if high < 200 * low:
        axes.xaxis.set_major_locator(_one_two_five())
    _label(axes, ends, [curve.estimator.label(group) for curve in curves])
    figure.text(0.985, 0.015, note, ha="right", va="bottom", fontsize=9, color=SOFT)
    return figure


def _figure(measured: Measured, group: str, curves: Sequence[Curve]) -> tuple[Figure, Axes]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 5.625))
    axes = figure.add_axes((0.1, 0.15, 0.605, 0.62))
    title = f"{measured.module.title.capitalize()}: {measured.module.groups[group]}"
    figure.text(0.03, 0.945, title, fontsize=20, fontweight="bold", va="center")
    width, height = measured.size
    seeds = curves[0].mse.shape[1]
    about = f"RMSE against the converged picture; {width} x {height} pixels, mean of {seeds} seeds"
    figure.text(0.03, 0.875, about, fontsize=13, color=SOFT, va="center")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(visible=True, which="major", color="#e2e2e2", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.text(0, 1.03, "RMSE", transform=axes.transAxes, ha="right", va="bottom")
    return figure, axes


def _draw(
    axes: Axes, group: str, curves: Sequence[Curve], horizontal: Sequence[Floats64]
) -> list[tuple[float, float, str]]:
    """The lines; where each ends, and its colour."""
    ends = []
    for number, (curve, x) in enumerate(zip(curves, horizontal, strict=True)):
        style = STYLES[curve.estimator.sampler] if group == "samplers" else number
        color = COLORS[style % len(COLORS)]
        axes.plot(
            x,
            curve.rmse,
            color=color,
            marker=MARKERS[style % len(MARKERS)],
            markersize=8,
            linewidth=2.6,
            solid_capstyle="round",
        )
        ends.append((float(x[-1]), float(curve.rmse[-1]), color))
    axes.yaxis.set_major_formatter(_plain_numbers())
    axes.yaxis.set_minor_formatter(_nothing())
    floor = max(curve.reference.error for curve in curves)
    low, high = axes.get_ylim()
    if floor > 0:
        axes.axhspan(floor * 1e-3, floor, color="#ededed", zorder=0)
        axes.set_ylim(min(low, floor * 0.7), high)
        axes.annotate(
            "error of the reference itself",
            (0.012, floor),
            xycoords=("axes fraction", "data"),
            xytext=(0, -3),
            textcoords="offset points",
            fontsize=11,
            color=SOFT,
            va="top",
        )
    low, high = axes.get_ylim()
    if high < 200 * low:
        axes.yaxis.set_major_locator(_one_two_five())
    return ends


def _slopes(axes: Axes, x: Floats64, curves: Sequence[Curve]) -> None:
    """Thin lines of order -1/2 and -1, through the first point of the largest error."""
    start = max(float(curve.rmse[0]) for curve in curves)
    ends = np.array([x[0], x[-1]])
    low, high = axes.get_ylim()
    for power, name in ((-0.5, "order -1/2"), (-1.0, "order -1")):
        y = start * (ends / ends[0]) ** power
        axes.plot(ends, y, color=SOFT, linewidth=1, linestyle=(0, (2, 3)), zorder=1)
        at = float(np.exp(0.62 * np.log(ends[1] / ends[0]))) * ends[0]
        value = start * (at / ends[0]) ** power
        if low < value < high:
            above = power > -0.75
            axes.annotate(
                name,
                (at, value),
                xytext=(4, 5) if above else (-4, -5),
                textcoords="offset points",
                fontsize=11,
                color=SOFT,
                ha="left" if above else "right",
                va="bottom" if above else "top",
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1, "alpha": 0.8},
                zorder=1.5,
            )
    axes.set_ylim(low, high)


def _label(axes: Axes, ends: Sequence[tuple[float, float, str]], labels: Sequence[str]) -> None:
    """Names at the right, beside the ends of their lines and one line of text apart."""
    to_pixels, to_share = axes.transData, axes.transAxes.inverted()
    shares = [to_share.transform(to_pixels.transform((x, y))) for x, y, _ in ends]
    for number, height in enumerate(spread([float(y) for _, y in shares], 0.078)):
        x, y = map(float, shares[number])
        color = ends[number][2]
        axes.annotate(
            "",
            (x, y),
            xytext=(1.025, height),
            xycoords="axes fraction",
            textcoords="axes fraction",
            arrowprops={
                "arrowstyle": "-",
                "color": color,
                "linewidth": 1,
                "alpha": 0.6,
                "shrinkA": 0,
            },
            annotation_clip=False,
        )
        axes.text(
            1.032,
            height,
            labels[number],
            transform=axes.transAxes,
            color=color,
            fontsize=14,
            fontweight="bold",
            va="center",
        )


def spread(heights: Sequence[float], gap: float) -> list[float]:
    """Heights moved as little as need be to lie at least a gap apart, in the same order.

    Neighbours that are too near are put side by side about their mean, and then count as one.
    """
    order = sorted(range(len(heights)), key=lambda number: heights[number])
    clusters: list[list[int]] = []
    for number in order:
        clusters.append([number])
        while len(clusters) > 1 and _touch(clusters[-2], clusters[-1], heights, gap):
            last = clusters.pop()
            clusters[-1] += last
    placed = [0.0] * len(heights)
    for cluster in clusters:
        for number, height in zip(cluster, _column(cluster, heights, gap), strict=True):
            placed[number] = height
    return placed


def _touch(lower: list[int], upper: list[int], heights: Sequence[float], gap: float) -> bool:
    top, bottom = _column(lower, heights, gap)[-1], _column(upper, heights, gap)[0]
    return bottom - top < gap


def _column(cluster: list[int], heights: Sequence[float], gap: float) -> list[float]:
    middle = sum(heights[number] for number in cluster) / len(cluster)
    first = middle - gap * (len(cluster) - 1) / 2
    return [first + gap * place for place in range(len(cluster))]


def _powers_of_four(axes: Axes, horizontal: Sequence[Floats64]) -> None:
    from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

    last = max(float(x[-1]) for x in horizontal)
    ticks = [4**power for power in range(12) if 4**power <= last * 1.01]
    axes.xaxis.set_major_locator(FixedLocator([float(tick) for tick in ticks]))
    axes.xaxis.set_major_formatter(FixedFormatter([str(tick) for tick in ticks]))
    axes.xaxis.set_minor_locator(NullLocator())


def _plain_numbers() -> Any:
    from matplotlib.ticker import FuncFormatter

    return FuncFormatter(lambda value, _: f"{value:g}" if value >= 1e-4 else f"{value:.0e}")


def _one_two_five() -> Any:
    from matplotlib.ticker import LogLocator

    return LogLocator(subs=(1.0, 2.0, 5.0))


def _nothing() -> Any:
    from matplotlib.ticker import NullFormatter

    return NullFormatter()
