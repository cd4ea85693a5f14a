"""Points and histograms, as SVG elements that take the page's own colour of text.

Each plot is a matplotlib figure of its own: nothing is shared between threads, and no global setting is changed.
"""

from __future__ import annotations

import re
from io import StringIO
from typing import Any

import numpy as np
from matplotlib.figure import Figure as Canvas

from course.core.types import Floats64
from course.grading.checks.check import Array, Figure
from course.grading.reports.panels import Drawing, NotDrawable, Panel, numbers

YOURS, EXPECTED = "#d9622b", "#3f8fc9"
"""Readable on white and on black, and told apart with any colour vision."""

MOST_POINTS = 2500
FURTHEST = 1e12
"""Beyond this nothing is drawn: the axes could not be labelled."""

_INK = "#123456"
"""Becomes the colour of the text around the plot."""


def draw_points(figure: Figure) -> Drawing:
    """Draw ``yours`` and, if it is there, ``expected``: (2, N) numbers in the unit square or disk.

    Raises
    ------
    NotDrawable
        Neither of the two is points.
    """
    sets: dict[str, Floats64] = {}
    notes: list[str] = []
    for name, label in (("yours", "Yours"), ("expected", "The reference")):
        if name in figure.arrays:
            try:
                sets[name] = _points(figure.arrays[name], label, notes)
            except NotDrawable as reason:
                notes.append(f"{reason}.")
    if not sets:
        raise NotDrawable(" ".join(notes).rstrip(".") or "there are no points")
    standard = sets.get("expected", sets.get("yours"))
    assert standard is not None
    disk = bool((standard < 0).mean() > 0.05)
    low, high = _view(sets, -1.0 if disk else 0.0)
    panels = []
    for name, title, color in (("yours", "Yours", YOURS), ("expected", "Reference", EXPECTED)):
        if name in sets:
            panels.append(_scatter(sets[name], title, color, disk, low, high))
    return Drawing(figure.title, tuple(panels), tuple(notes))


def _points(array: Array, label: str, notes: list[str]) -> Floats64:
    found = numbers(array, label)
    if found.ndim != 2 or 2 not in found.shape:
        if found.ndim < 2 or found.shape[0] != 2:
            raise NotDrawable(f"{label} has the shape {found.shape}, which is no points (2, N)")
        found = found.reshape(2, -1)
    elif found.shape[0] != 2:
        notes.append(f"{label} has the shape {found.shape}, with the two coordinates last.")
        found = found.T
    step = -(-found.shape[1] // MOST_POINTS)
    if step > 1:
        notes.append(f"{label} has {found.shape[1]} points; one in {step} is drawn.")
    with np.errstate(all="ignore"):
        points: Floats64 = found[:, ::step].astype(np.float64)
    return _within(points, label, "points", notes)


def _within(values: Floats64, label: str, what: str, notes: list[str]) -> Floats64:
    """Those that can be drawn, of values along the last axis."""
    fine = (np.abs(np.nan_to_num(values, nan=np.inf)) < FURTHEST).reshape(-1, values.shape[-1])
    kept = fine.all(axis=0)
    if not kept.all():
        notes.append(
            f"{label} has {int((~kept).sum())} of {kept.size} {what} that are NaN, infinite or huge; "
            "they are left out."
        )
    if not kept.any():
        raise NotDrawable(f"{label} has no finite {what}")
    result: Floats64 = values[..., kept]
    return result


def _view(sets: dict[str, Floats64], low: float) -> tuple[Floats64, Floats64]:
    """Corners (2,) of what is seen: the unit square or disk, and nearly all points."""
    both = np.concatenate(tuple(sets.values()), axis=1)
    least = np.minimum(np.percentile(both, 0.5, axis=1), low)
    most = np.maximum(np.percentile(both, 99.5, axis=1), 1.0)
    margin = 0.03 * (most - least)
    return least - margin, most + margin


def _scatter(
    points: Floats64, title: str, color: str, disk: bool, low: Floats64, high: Floats64
) -> Panel:
    width, height = high - low
    square = 0.2 < width / height < 5
    canvas, axes = _axes((3.6, 3.6))
    if disk:
        turn = np.linspace(0, 2 * np.pi, 181)
        axes.plot(np.cos(turn), np.sin(turn), color=_INK, linewidth=0.8)
    else:
        axes.plot([0, 1, 1, 0, 0], [0, 0, 1, 1, 0], color=_INK, linewidth=0.8)
    axes.scatter(
        *points, s=float(np.clip(6000 / points.shape[1], 5, 36)), color=color, lw=0, rasterized=True
    )
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal" if square else "auto")
    axes.set_xlabel("first coordinate")
    axes.set_ylabel("second coordinate")
    outside = int(((points < low[:, None]) | (points > high[:, None])).any(axis=0).sum())
    seen = f"{points.shape[1]} points"
    caption = seen + (f", {outside} of them outside of the axes" if outside else "")
    shape = "the unit disk" if disk else "the unit square"
    mean = ", ".join(f"{value:.3g}" for value in points.mean(axis=1))
    alt = f"{title}: {seen} drawn over {shape}; their mean is ({mean})."
    return Panel(title, alt, f"{caption}; the line is {shape}", svg=_svg(canvas))


def draw_histogram(figure: Figure) -> Drawing:
    """Draw how often the values of ``yours`` occur, and of ``expected`` or the right ``density`` if it is there.

    Parameters
    ----------
    figure : its ``yours`` and ``expected`` are values of any shape; ``density`` is (2, M), places and the density
        there, or (M,), the density at places spread evenly over the values' range

    Raises
    ------
    NotDrawable
        There is no finite value.
    """
    notes: list[str] = []
    sets: dict[str, Floats64] = {}
    for name, label in (("yours", "Yours"), ("expected", "The reference")):
        if name in figure.arrays:
            with np.errstate(all="ignore"):
                try:
                    values = numbers(figure.arrays[name], label).astype(np.float64).ravel()
                    sets[name] = _within(values, label, "values", notes)
                except NotDrawable as reason:
                    notes.append(f"{reason}.")
    if not sets:
        raise NotDrawable(" ".join(notes).rstrip(".") or "there are no values")
    everything = np.concatenate(tuple(sets.values()))
    low, high = float(everything.min()), float(everything.max())
    if 0 < low < 0.1 * high:
        low = 0.0
    if low >= 0 and 0.5 < high <= 1:
        low, high = 0.0, 1.0
    if high - low < 1e-9 * max(abs(low), abs(high), 1e-30):
        low, high = low - 0.5 * max(1.0, abs(low)), high + 0.5 * max(1.0, abs(high))
    edges = np.linspace(low, high, int(np.clip(np.sqrt(everything.size), 8, 40)) + 1)
    canvas, axes = _axes((4.2, 2.9))
    labels = {"yours": "yours", "expected": "reference"}
    for name, values in sets.items():
        share = np.histogram(values, edges)[0] / values.size / np.diff(edges)
        if name == "yours":
            axes.bar(edges[:-1], share, np.diff(edges), align="edge", color=YOURS, label="yours")
        else:
            axes.stairs(share, edges, color=EXPECTED, linewidth=2, label="reference")
    if _density(axes, figure.arrays.get("density"), low, high, notes):
        labels["density"] = "right density"
    axes.set_xlim(low, high)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("value")
    axes.set_ylabel("density")
    if len(sets) + ("density" in labels) > 1:
        axes.legend(frameon=False, labelcolor=_INK, fontsize=10)
    told = "; ".join(
        f"{labels[name]}: {values.size} values from {values.min():.4g} to {values.max():.4g}, "
        f"mean {values.mean():.4g}"
        for name, values in sets.items()
    )
    panel = Panel("How often each value occurs", f"Histogram. {told}.", told, svg=_svg(canvas))
    return Drawing(figure.title, (panel,), tuple(notes))


def _density(axes: Any, density: Array | None, low: float, high: float, notes: list[str]) -> bool:
    if density is None:
        return False
    try:
        found = numbers(density, "The density").astype(np.float64)
        if found.ndim == 1:
            found = np.stack((np.linspace(low, high, found.size), found))
        if found.ndim != 2 or found.shape[0] != 2:
            raise NotDrawable(f"The density has the shape {found.shape}")
        places, heights = _within(found, "The density", "values", notes)
    except NotDrawable as reason:
        notes.append(f"{reason}.")
        return False
    axes.plot(places, heights, color=EXPECTED, linewidth=2, label="right density")
    return True


def _axes(inches: tuple[float, float]) -> tuple[Any, Any]:
    canvas = Canvas(figsize=inches)
    canvas.patch.set_visible(False)
    axes = canvas.add_axes((0.2, 0.17, 0.76, 0.79))
    axes.patch.set_visible(False)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color(_INK)
    axes.tick_params(colors=_INK, labelsize=10)
    axes.locator_params(nbins=5)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set_color(_INK)
        axis.label.set_fontsize(11)
        axis.get_offset_text().set_color(_INK)
    return canvas, axes


def _svg(canvas: Any) -> str:
    buffer = StringIO()
    canvas.savefig(buffer, format="svg", dpi=160, metadata={"Date": None})
    text = buffer.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>|<style.*?</style>|<!--.*?-->", "", text, flags=re.S)
    box = re.search(r'viewBox="([^"]*)"', text)
    text = re.sub(r"<svg[^>]*>", f'<svg viewBox="{box[1] if box else ""}">', text, count=1)
    return text.replace(_INK, "currentColor").strip()


_IDS = re.compile(r'(\sid="|href="#|url\(#)([^")]+)')


def with_own_ids(svg: str, prefix: str) -> str:
    """The same element with names that no other plot of the page has."""
    names: dict[str, str] = {}

    def rename(match: re.Match[str]) -> str:
        return match[1] + names.setdefault(match[2], f"{prefix}-{len(names)}")

    return _IDS.sub(rename, svg)
