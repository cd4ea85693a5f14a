"""Small plots: points, curves and boxes in dark ink on white."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image

from sitebuild.mistakes.look import SIZE, Draw

if TYPE_CHECKING:
    from matplotlib.axes import Axes

INK, RIGHT, LINE, SECOND = "#a1440b", "#8a8a8a", "#b9b9b9", "#1f5fa8"
"""Of what the function made, of what the right one makes, of outlines, and of a second thing."""

SHARPNESS = 2
"""Pixels of the picture for a pixel of the page."""

Array = np.ndarray[Any, Any]
Plot = Callable[["Axes", ModuleType, ModuleType], None]


def plot(draw: Plot, *, curve: bool = False) -> Draw:
    """Make a `Draw` of a function that fills axes; those of a curve have their ticks."""
    return partial(_plotted, draw, curve)


def is_plot(draw: Draw) -> bool:
    """True if a ``Draw`` makes a plot, and no picture."""
    return getattr(draw, "func", None) is _plotted


def _plotted(draw: Plot, curve: bool, made: ModuleType, right: ModuleType) -> Image.Image:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(SIZE[0] / 100, SIZE[1] / 100), dpi=100 * SHARPNESS)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0.13, 0.2, 0.84, 0.75) if curve else (0.01, 0.01, 0.98, 0.98))
    if curve:
        axes.tick_params(labelsize=7, length=2, pad=1.5)
        axes.locator_params(nbins=4)
        axes.spines[["top", "right"]].set_visible(False)
    else:
        axes.set_axis_off()
    draw(axes, made, right)
    canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3])


def label(axes: Axes, x: str, size: float = 7.5) -> None:
    """Name what runs to the right."""
    axes.set_xlabel(x, fontsize=size, labelpad=1)


def view(axes: Axes, x: tuple[float, float], y: tuple[float, float]) -> None:
    """Show at least that part of the plane, as wide as it is high in the same units."""
    place = axes.get_position()
    shape = place.width * SIZE[0] / (place.height * SIZE[1])
    half_width = max(x[1] - x[0], (y[1] - y[0]) * shape) / 2
    half_height = half_width / shape
    axes.set_xlim(sum(x) / 2 - half_width, sum(x) / 2 + half_width)
    axes.set_ylim(sum(y) / 2 - half_height, sum(y) / 2 + half_height)


def dots(axes: Axes, points: Array, color: str = INK, size: float = 3) -> None:
    """Points (2, N); those that aren't numbers are left out."""
    axes.scatter(*np.asarray(points, float), s=size, c=color, linewidths=0, zorder=3)


def polygon(axes: Axes, *corners: tuple[float, float], **style: Any) -> None:
    """A closed outline."""
    x, y = zip(*corners, corners[0], strict=True)
    axes.plot(x, y, **{"color": LINE, "linewidth": 1} | style)


def square(axes: Axes, x0: float, y0: float, x1: float, y1: float, **style: Any) -> None:
    """The outline of a rectangle along the axes."""
    polygon(axes, (x0, y0), (x1, y0), (x1, y1), (x0, y1), **style)


def circle(axes: Axes, x: float, y: float, radius: float, turn: float = 1, **style: Any) -> None:
    """The outline of a circle, or the upper part of it."""
    angle = np.linspace(0, 2 * np.pi * turn, 97)
    style = {"color": LINE, "linewidth": 1} | style
    axes.plot(x + radius * np.cos(angle), y + radius * np.sin(angle), **style)


def curves(axes: Axes, x: Array, made: Array, right: Array, **style: Any) -> None:
    """What the function makes over what the right one makes."""
    axes.plot(x, right, color=RIGHT, linewidth=3.2, alpha=0.6)
    axes.plot(x, made, **{"color": INK, "linewidth": 1.4} | style)


def histogram(
    axes: Axes, values: Array, density: Callable[[Array], Array], span: tuple[float, float]
) -> None:
    """How often values are in each bin, and the density that they should have."""
    values = values[np.isfinite(values)]
    count, edges = np.histogram(values, 24, span)
    axes.stairs(count / max(len(values), 1) / np.diff(edges), edges, fill=True, color=INK)
    x = np.linspace(*span, 200)
    axes.plot(x, density(x), color="#333", linewidth=1.4, zorder=4)
    axes.set_xlim(*span)
    axes.set_yticks([])
