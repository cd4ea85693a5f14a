"""Figures for lectures: the lines of a plot on logarithmic axes, named at their ends.

matplotlib is an extra, imported when a figure is asked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np

from course.base.atomic import replacing
from course.base.errors import CourseError
from course.benchmarking.labels import name_lines, plain, powers_of_four, ticks
from course.benchmarking.measuring import Measured
from course.benchmarking.plot_data import Plot, Series, comparisons
from course.benchmarking.tables import digits

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
"""matplotlib's settings while a figure is made and written."""

WIDE = (10.0, 5.625)
"""Width and height of a figure [inches], 16 : 9."""

LETTERS = 50
"""Letters that have room below the axes."""

ABOVE = 1.25
"""Slopes start above the largest first error by this factor."""


def check_matplotlib() -> None:
    """Find out before the work whether figures can be drawn.

    Raises CourseError: matplotlib is not installed.
    """
    if find_spec("matplotlib") is None:
        raise CourseError(
            "plots need matplotlib, which is not installed: python -m pip install -e '.[bench]'"
        )


def write_comparisons(measured: Measured, folder: Path, note: str) -> list[Path]:
    """Draw every comparison of a module that was measured, as MODULE_GROUP_samples.svg and MODULE_GROUP_seconds.svg.

    Raises CourseError, OutputError: matplotlib is not installed, or a file can't be written.
    ``folder``, ``note``: as `write_plots` takes them.
    """
    module = measured.module
    width, height = measured.size
    seeds = measured.curves[0].mse.shape[1]
    about = f"RMSE against the converged picture; {width} x {height} pixels, mean of {seeds} seeds"
    titled = [
        msgspec.structs.replace(plot, title=f"{module.title}: {plot.title}")
        for plot in comparisons(measured)
    ]
    return write_plots(module.name, titled, about, folder, note)


def write_plots(
    name: str, plots: Iterable[Plot], about: str, folder: Path, note: str = ""
) -> list[Path]:
    """Draw plots along each of their axes, as NAME_PLOT_AXIS.svg.

    Raises CourseError, OutputError: matplotlib is not installed, or a file can't be written.

    Parameters
    ----------
    about : with what effort the plots were measured
    folder : of the SVG files; it is there
    note : small below the figures that show seconds
    """
    check_matplotlib()
    from matplotlib import rc_context

    written = []
    for plot in plots:
        for axis in plot.axes:
            with rc_context(STYLE):
                figure = draw(plot, axis, about, note)
                written.append(write(figure, folder / f"{name}_{plot.name}_{axis}.svg"))
    return written


def write(figure: Figure, path: Path) -> Path:
    """Write a figure as `.svg` or `.png`; the same figure gives the same bytes."""
    kind = path.suffix.removeprefix(".")
    with replacing(path) as temporary:
        figure.savefig(temporary, format=kind, metadata={"Date": None} if kind == "svg" else None)
    return path


def draw(plot: Plot, axis: str, about: str, note: str = "") -> Figure:
    """Draw a plot along one of its axes, in `STYLE`."""
    figure = sheet(f"{plot.title[:1].upper()}{plot.title[1:]}", about)
    draw_lines(figure.add_axes((0.1, 0.15, 0.605, 0.62)), plot, axis)
    if axis == "seconds":
        figure.text(0.985, 0.015, note, ha="right", va="bottom", fontsize=9, color=SOFT)
    return figure


def sheet(title: str, about: str, size: tuple[float, float] = WIDE) -> Figure:
    """Make a figure of a size [inches] with nothing but its title, and below it how it was measured."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=size)
    line = WIDE[1] / size[1]
    figure.text(0.03, 1 - 0.055 * line, title, fontsize=20, fontweight="bold", va="center")
    figure.text(0.03, 1 - 0.125 * line, about, fontsize=13, color=SOFT, va="center")
    return figure


def draw_lines(axes: Axes, plot: Plot, axis: str, names: Mapping[str, str] | None = None) -> None:
    """Fill axes with a plot's lines along one of its axes.

    ``names``: series -> name at the end of its line; None means its own name, with the fitted order over counts.
    """
    axes.set(xscale="log", yscale="log", xlabel=plot.axes[axis])
    axes.grid(visible=True, which="major", color="#e2e2e2", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.text(0, 1.03, plot.y, transform=axes.transAxes, ha="left", va="bottom")
    for series in plot.series:
        _draw_line(axes, series, axis)
    if plot.floor:
        _draw_floor(axes, plot.floor)
    if plot.slope and axis != "seconds" and not any(series.limit for series in plot.series):
        _draw_slopes(axes, plot, axis)
    _number_axes(axes, [x for series in plot.series for x in series.x[axis]])
    measured = [series for series in plot.series if not series.predicted]
    name_lines(
        axes,
        [(series.x[axis][-1], series.y[-1]) for series in measured],
        [names[s.name] if names else _name(s, axis) for s in measured],
        [_color(series) for series in measured],
    )


def _name(series: Series, axis: str) -> str:
    ordered = series.order is not None and axis != "seconds"
    return f"{series.name}  {series.order:.2f}" if ordered else series.name


def _color(series: Series) -> str:
    return COLORS[series.style % len(COLORS)]


def _draw_line(axes: Axes, series: Series, axis: str) -> None:
    """Draw a series: marked where measured, dashed where predicted, dotted where its error comes to a limit."""
    x, color = series.x[axis], _color(series)
    if series.predicted:
        axes.plot(x, series.y, color=color, linestyle=(0, (4, 2)), linewidth=1.4)
        return
    marker = MARKERS[series.style % len(MARKERS)]
    axes.plot(x, series.y, color=color, marker=marker, markersize=7.5, linewidth=2.5)
    if series.limit:
        axes.hlines(series.limit, x[0], x[-1], colors=color, linestyles="dotted")
        axes.annotate(
            f"bias {digits(series.limit)}",
            (x[0], series.limit),
            xytext=(2, 3),
            textcoords="offset points",
            fontsize=11,
            color=color,
        )


def _draw_floor(axes: Axes, floor: float) -> None:
    """Shade what lies below the error of the reference itself."""
    low, high = axes.get_ylim()
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


def _draw_slopes(axes: Axes, plot: Plot, axis: str) -> None:
    """Draw thin lines of order -1/2 and -1 from above the first points."""
    places = [x for series in plot.series for x in series.x[axis]]
    ends = np.array([min(places), max(places)])
    start = ABOVE * max(series.y[0] for series in plot.series)
    low, high = axes.get_ylim()
    for power, name in ((-0.5, "order -1/2"), (-1.0, "order -1")):
        axes.plot(
            ends,
            start * (ends / ends[0]) ** power,
            color=SOFT,
            linewidth=1,
            linestyle=(0, (2, 3)),
            zorder=1,
        )
        at = float(ends[0] * (ends[1] / ends[0]) ** 0.62)
        value = start * (at / float(ends[0])) ** power
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


def _number_axes(axes: Axes, places: Iterable[float]) -> None:
    """Put round numbers along both axes, as many as have room."""
    from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator

    fours = powers_of_four(places)
    x = ticks(*axes.get_xlim(), 7, fours=fours)
    width = 2 + max((len(_short(tick)) for tick in x), default=1)
    if len(x) * width > LETTERS:
        x = ticks(*axes.get_xlim(), LETTERS // width, fours=fours)
    y = ticks(*axes.get_ylim(), 7)
    for line, chosen in ((axes.xaxis, x), (axes.yaxis, y)):
        line.set_major_locator(FixedLocator(chosen))
        line.set_major_formatter(FixedFormatter([_short(tick) for tick in chosen]))
        line.set_minor_locator(NullLocator())


def _short(value: float) -> str:
    """Write a number with as few zeros as fit beside the axis: 16,384, 0.0001, 1e-05."""
    return plain(value) if value >= 1e-4 else f"{value:.0e}"
