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
    from matplotlib.backends.backend_agg import FigureCanvasAgg

INK, RIGHT, LINE, SECOND = "#a1440b", "#8a8a8a", "#b9b9b9", "#1f5fa8"
"""Of what the function made, of what the right one makes, of outlines, and of a second thing."""

BELOW: dict[str, Any] = {"linewidth": 3.2, "alpha": 0.6}
ABOVE: dict[str, Any] = {"linewidth": 1.4}
"""Lines of what is right, and of what was made, which lies over it."""

SHARPNESS = 2
"""Pixels of the picture for a pixel of the page."""

BINS, PLACES = 24, 16
"""Of a histogram, and where in each of them its density is asked for."""

MARGIN = 2 * SHARPNESS
"""Pixels of the picture between its border and what is written next to it."""

SMALL = 7
"""Size of the numbers at ticks."""

Array = np.ndarray[Any, Any]
Plot = Callable[["Axes", ModuleType, ModuleType], None]


def plot(draw: Plot, *, curve: bool = False) -> Draw:
    """Make a `Draw` of a function that fills axes; those of a curve have their ticks."""
    return partial(_plotted, draw, curve)


def drawn(x: Array, value: Callable[[ModuleType], Array], name: str) -> Draw:
    """Curves of values (N,) or (k, N) that a module makes over x (N,), above those of the right one; ``name``: of x."""

    def draw(axes: Axes, made: ModuleType, right: ModuleType) -> None:
        for row, below in zip(np.atleast_2d(value(made)), np.atleast_2d(value(right)), strict=True):
            curves(axes, x, row, below)
        label(axes, name)

    return plot(draw, curve=True)


def is_plot(draw: Draw) -> bool:
    """True if a ``Draw`` makes a plot, and no picture."""
    return getattr(draw, "func", None) is _plotted


def _plotted(draw: Plot, curve: bool, made: ModuleType, right: ModuleType) -> Image.Image:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from sitebuild.mistakes.tick_numbers import TickNumbers

    figure = Figure(figsize=(SIZE[0] / 100, SIZE[1] / 100), dpi=100 * SHARPNESS)
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_axes((0.13, 0.2, 0.84, 0.75) if curve else (0.01, 0.01, 0.98, 0.98))
    if curve:
        axes.tick_params(labelsize=SMALL, length=2, pad=1.5)
        axes.locator_params(nbins=4)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(TickNumbers())
            axis.get_offset_text().set_size(SMALL)
        axes.spines[["top", "right"]].set_visible(False)
    else:
        axes.set_axis_off()
    draw(axes, made, right)
    if curve:
        _make_room(axes, canvas)
    canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3])


def _make_room(axes: Axes, canvas: FigureCanvasAgg) -> None:
    """Move the sides of axes inwards until nothing that is written around them is cut off."""
    renderer = canvas.get_renderer()
    width, height = canvas.get_width_height()
    name = axes.xaxis.label
    if name.get_window_extent(renderer).width > width - 2 * MARGIN:
        name.set_text(_in_two_lines(name.get_text()))
    written = axes.get_tightbbox(renderer, for_layout_only=True)
    place = axes.get_position()
    left = place.x0 + max(MARGIN - written.x0, 0) / width
    bottom = place.y0 + max(MARGIN - written.y0, 0) / height
    right = place.x1 - max(written.x1 - (width - MARGIN), 0) / width
    top = place.y1 - max(written.y1 - (height - MARGIN), 0) / height
    axes.set_position((left, bottom, right - left, top - bottom))
    # A name that is wider than the axes isn't below their middle.
    extent = name.get_window_extent(renderer)
    middle = (left + right) / 2 * width
    half = extent.width / 2 + MARGIN
    name.set_x(0.5 + (np.clip(middle, half, width - half) - middle) / axes.bbox.width)


def _in_two_lines(words: str) -> str:
    """Break them at the space that is nearest to the middle."""
    spaces = [place for place, letter in enumerate(words) if letter == " "]
    middle = min(spaces, key=lambda place: abs(place - len(words) / 2))
    return f"{words[:middle]}\n{words[middle + 1 :]}"


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


def curves(
    axes: Axes, x: Array, made: Array, right: Array, drawstyle: str = "default", **style: Any
) -> None:
    """What the function makes over what the right one makes, as the same kind of line."""
    made, right = np.asarray(made), np.asarray(right)
    below, above = {"color": RIGHT, **BELOW}, {"color": INK, **ABOVE} | style
    axes.plot(x, right, drawstyle=drawstyle, **below)
    axes.plot(x, made, drawstyle=drawstyle, **above)
    _mark_lost(axes, x, made, right)


def steps(axes: Axes, made: Array, right: Array) -> None:
    """A value for each whole number, from 0 on: those that the function makes over those of the right one."""
    for values, color, style in ((right, RIGHT, BELOW), (made, INK, ABOVE)):
        edges = np.arange(np.size(values) + 1) - 0.5
        axes.stairs(np.asarray(values, float), edges, baseline=None, color=color, **style)
    _mark_lost(axes, np.arange(np.size(right)), made, right)


def _mark_lost(axes: Axes, x: Array, made: Array, right: Array) -> None:
    """Say that there is no number where a line has a gap, or isn't there at all."""
    lost = np.isnan(made) & ~np.isnan(right)
    if lost.any():
        place = np.broadcast_to(x, lost.shape)[lost]
        middle = (place.min() + place.max()) / 2
        axes.text(
            middle,
            0.5,
            "no number",
            transform=axes.get_xaxis_transform(),
            fontsize=SMALL,
            ha="center",
            va="center",
            color=INK,
        )


def histogram(
    axes: Axes, values: Array, density: Callable[[Array], Array], span: tuple[float, float]
) -> None:
    """How often values are in each bin, and how often they should be."""
    values = values[np.isfinite(values)]
    count, edges = np.histogram(values, BINS, span)
    axes.stairs(count / max(len(values), 1) / np.diff(edges), edges, fill=True, color=INK)
    share = (np.arange(BINS * PLACES) + 0.5) / (BINS * PLACES)
    places = span[0] + share * (span[1] - span[0])
    expected = density(places).reshape(BINS, PLACES).mean(axis=1)
    axes.stairs(expected, edges, baseline=None, color="#333", linewidth=1.4, zorder=4)
    axes.set_xlim(*span)
    axes.set_yticks([])
