"""Cells in the colours of their corners, and cells cut into children."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING

import numpy as np

from sitebuild.mistakes.look import Look
from sitebuild.mistakes.plots import INK, SECOND, plot, square, view
from sitebuild.mistakes.swatches import swatches

if TYPE_CHECKING:
    from matplotlib.axes import Axes

GREY, RED, GREEN = (0.55, 0.55, 0.55), (0.8, 0.1, 0.1), (0.1, 0.8, 0.1)

Color = tuple[float, float, float]


def _grey(value: float) -> Color:
    return (value, value, value)


CELLS: tuple[tuple[Color, Color, Color, Color], ...] = (
    (GREY,) * 4,
    (_grey(0.15), _grey(0.9), _grey(0.15), _grey(0.9)),
    (_grey(0.125), _grey(0.375), _grey(0.5), _grey(0.875)),
    (_grey(0.45), _grey(0.15), _grey(0.8), _grey(0.45)),
    (RED, RED, GREEN, GREEN),
    ((0.3, 0.3, 0.2), (0.3, 0.3, 0.9), (0.3, 0.3, 0.2), (0.3, 0.3, 0.9)),
    ((0.8, 0.1, 0.1),) * 4,
    (_grey(0.25), _grey(0.25), _grey(0.75), _grey(0.75)),
    (_grey(0.02), _grey(0.02), _grey(0.15), _grey(0.15)),
    (_grey(0.4), _grey(0.55), _grey(0.4), _grey(0.55)),
)
"""Corners: plain, an edge, corner to corner, middling, red and green, blue alone, red, at the threshold, dark, dim."""


def _marked(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    cells = np.array(CELLS, np.float32).transpose(2, 1, 0)
    swatches(axes, cells, np.asarray(made.needs_subdivision(cells, 0.5)).astype(bool))


def _children(axes: Axes, made: ModuleType, _: ModuleType) -> None:
    cell = [np.array([value], np.float32) for value in (2.0, 1.0, 5.0, 3.0)]
    square(axes, 2, 1, 5, 3, color="#888", linewidth=3.5)
    for number, (x0, y0, x1, y1) in enumerate(zip(*made.subdivide(*cell), strict=True)):
        x0, y0, x1, y1 = (float(value[0]) for value in (x0, y0, x1, y1))
        color = (INK, SECOND, "#3c8d40", "#8a4fa3")[number]
        inset = 0.06
        square(axes, x0 + inset, y0 + inset, x1 - inset, y1 - inset, color=color, linewidth=1.5)
        axes.text(
            (x0 + x1) / 2,
            (y0 + y1) / 2,
            str(number),
            color=color,
            fontsize=11,
            ha="center",
            va="center",
        )
    view(axes, (0.6, 5.4), (0.3, 3.4))


LOOKS = {
    "needs_subdivision": (
        Look(
            "Ten cells in the colours of their corners, threshold 0.5; a cross means: divide",
            plot(_marked),
        ),
    ),
    "subdivide": (
        Look("A cell (grey) and its children by their numbers; y grows upwards", plot(_children)),
    ),
}
