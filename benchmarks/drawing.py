"""What the figures of the lectures have in common: a title, what was measured, and lines named at their ends.

Like those of `course bench`: the same colours, letters and sizes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from course.benchmarking.plots import COLORS, MARKERS, SOFT, STYLE, spread
from course.core.types import Floats64
from course.imaging.atomic import replacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Sheet

OUT = Path("out/bench")
LINE = 0.078
"""Height of a line of text as a share of the axes'."""


@dataclass(frozen=True)
class Line:
    """A line of a plot and its name; ``marked`` at its points, or plain for what was predicted."""

    name: str
    x: Floats64
    y: Floats64
    style: int
    marked: bool = True


def sheet(title: str, about: str, size: tuple[float, float] = (10, 5.625)) -> Sheet:
    """An empty figure under its title; size in inches."""
    from matplotlib.figure import Figure as Sheet

    figure = Sheet(figsize=size)
    height = 5.625 / size[1]
    figure.text(0.03, 1 - 0.055 * height, title, fontsize=20, fontweight="bold", va="center")
    figure.text(0.03, 1 - 0.125 * height, about, fontsize=13, color=SOFT, va="center")
    return figure


def logarithmic(axes: Axes, x: str, y: str) -> None:
    """Both axes logarithmic, with a light grid; x and y say what they show."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(visible=True, which="major", color="#e2e2e2", linewidth=0.8)
    axes.set_axisbelow(True)
    axes.set_xlabel(x)
    axes.text(0, 1.03, y, transform=axes.transAxes, ha="left", va="bottom")


def draw_lines(axes: Axes, lines: Sequence[Line], *, named: bool = True) -> None:
    """Draw lines, with their names to the right of the axes, beside their ends and one line of text apart."""
    for line in lines:
        shape: dict[str, Any] = {"linestyle": (0, (4, 2)), "linewidth": 1.4}
        if line.marked:
            marker = MARKERS[line.style % len(MARKERS)]
            shape = {"marker": marker, "markersize": 7, "linewidth": 2.4}
        axes.plot(line.x, line.y, color=COLORS[line.style % len(COLORS)], **shape)
    if not named:
        return
    # Asked for, limits are worked out; names are placed by them.
    axes.set(xlim=axes.get_xlim(), ylim=axes.get_ylim())
    share = axes.transData + axes.transAxes.inverted()
    ends = [share.transform((float(line.x[-1]), float(line.y[-1]))) for line in lines]
    heights = spread([float(end[1]) for end in ends], LINE)
    for line, end, height in zip(lines, ends, heights, strict=True):
        color = COLORS[line.style % len(COLORS)]
        arrow = {"arrowstyle": "-", "color": color, "linewidth": 1, "alpha": 0.6, "shrinkA": 0}
        axes.annotate(
            "",
            end,
            xytext=(1.03, height),
            xycoords="axes fraction",
            textcoords="axes fraction",
            arrowprops=arrow,
            annotation_clip=False,
        )
        axes.text(
            1.04,
            height,
            line.name,
            transform=axes.transAxes,
            color=color,
            fontsize=14,
            fontweight="bold",
            va="center",
        )


def slopes(axes: Axes, x: Floats64, start: float, orders: Sequence[tuple[float, str]]) -> None:
    """Thin lines of given orders from (x[0], start), to compare with."""
    low, high = axes.get_ylim()
    ends = np.array([x[0], x[-1]], np.float64)
    for order, name in orders:
        y = start * (ends / ends[0]) ** order
        axes.plot(ends, y, color=SOFT, linewidth=1, linestyle=(0, (2, 3)), zorder=1)
        at = float(ends[0] * (ends[1] / ends[0]) ** 0.62)
        if low < start * (at / ends[0]) ** order < high:
            axes.annotate(
                name,
                (at, start * (at / ends[0]) ** order),
                xytext=(4, 5) if order > -0.75 else (-4, -5),
                textcoords="offset points",
                fontsize=11,
                color=SOFT,
                ha="left" if order > -0.75 else "right",
                va="bottom" if order > -0.75 else "top",
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1, "alpha": 0.8},
                zorder=1.5,
            )
    axes.set_ylim(low, high)


def styled() -> Any:
    """The context in which a sheet is made and written."""
    from matplotlib import rc_context

    return rc_context(STYLE)


def write(figure: Sheet, path: Path) -> Path:
    """Write a figure, `.svg` or `.png`, and say so."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as temporary:
        kind = path.suffix.removeprefix(".")
        figure.savefig(temporary, format=kind, metadata={"Date": None} if kind == "svg" else None)
    print(f"written to {path}")
    return path
