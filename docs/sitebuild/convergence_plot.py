"""A plot on logarithmic axes as SVG that stands in a page: lines with marks, and what they are compared with.

Colours come from docs/_static/plots.css, for the light and the dark scheme. Each mark has its values as text, which
docs/_static/plot_values.js shows under the pointer.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from html import escape
from math import log, sqrt

from course.benchmarking.labels import plain, powers_of_four, ticks
from course.benchmarking.plot_data import Plot, Series
from course.benchmarking.tables import digits

WIDTH, HEIGHT = 340, 252
TOP, BOTTOM, RIGHT = 26, 40, 14
LETTER = 6.6
"""Width of a digit, a little more than it takes."""

STYLES = 6
"""How many colours and marks there are."""

MARKS = (
    "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z",
    "M-3.6 -3.6h7.2v7.2h-7.2z",
    "M0 -4.8L4.6 3.6H-4.6z",
    "M0 4.8L4.6 -3.6H-4.6z",
    "M0 -5.2L4.4 0L0 5.2L-4.4 0z",
    "M-1.5 -4.5h3v3h3v3h-3v3h-3v-3h-3v-3h3z",
)

NEAR = 8
"""The reference's own error has a place in a plot whose least error is at most so many times as large."""


@dataclass(frozen=True)
class Scale:
    """A logarithmic axis from low to high, drawn from start to end."""

    low: float
    high: float
    start: float
    end: float

    def __call__(self, value: float) -> float:
        """Return the place of a value."""
        share = log(value / self.low) / log(self.high / self.low)
        return round(self.start + share * (self.end - self.start), 1)


def svg(plot: Plot, axis: str) -> str:
    """Draw a plot along one of its axes; the result holds no empty line, so that Markdown keeps it whole."""
    x_values = [x for series in plot.series for x in series.x[axis]]
    y_values = [y for series in plot.series for y in series.y]
    lowest, highest = min(y_values), max(y_values)
    limits = [series.limit for series in plot.series if series.limit]
    band = plot.floor if plot.floor and plot.floor * NEAR > lowest else None
    low = min([lowest / 1.25, *(limit / 1.25 for limit in limits), *([0.7 * band] if band else [])])
    high = highest * 1.25
    y_ticks = ticks(low, high, 7)
    left = 12 + LETTER * max((len(plain(tick)) for tick in y_ticks), default=0)
    span = (max(x_values) / min(x_values)) ** 0.04 if len(set(x_values)) > 1 else 2.0
    x = Scale(min(x_values) / span, max(x_values) * span, left, WIDTH - RIGHT)
    y = Scale(low, high, HEIGHT - BOTTOM, TOP)
    parts = [
        *_axes(plot, axis, x, y, y_ticks, fours=powers_of_four(x_values)),
        *(_floor(band, x, y) if band else ()),
        *(_slope(plot, axis, x, y) if plot.slope else ()),
        *(_line(plot, axis, series, x, y) for series in plot.series if series.y),
    ]
    names = ", ".join(series.name for series in plot.series if not series.predicted)
    about = escape(f"{plot.title}: {plot.y} over {plot.axes[axis]}; {names}")
    return (
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{about}">\n'
        + "\n".join(parts)
        + "\n</svg>"
    )


def swatch(series: Series) -> str:
    """Draw what a line looks like, for the legend."""
    mark = "" if series.predicted else f'<path class="mark" d="{MARKS[series.style % STYLES]}"/>'
    return (
        f'<svg class="swatch s{series.style % STYLES}" viewBox="-15 -7 30 14" width="30" height="14"'
        f' aria-hidden="true"><path class="line{" predicted" * series.predicted}" d="M-14 0H14"/>{mark}</svg>'
    )


def values(plot: Plot, series: Series, number: int) -> str:
    """Say what a mark stands for: name, its place along every axis, its error."""
    places = [_counted(series.x[axis][number], about) for axis, about in plot.axes.items()]
    return f"{series.name}: {', '.join(places)}, {plot.y} {digits(series.y[number])}"


def amount(value: float) -> str:
    """Write a count as it is, anything else with three digits that count."""
    return f"{value:,}" if isinstance(value, int) else digits(value)


def _counted(value: float, about: str) -> str:
    """Put a number before what it counts: 4 samples, 1 sample."""
    words = re.sub(r"(?<=\w)s\b", "", about, count=1) if value == 1 else about
    return f"{amount(value)} {words}"


def _axes(
    plot: Plot, axis: str, x: Scale, y: Scale, y_ticks: Iterable[float], *, fours: bool
) -> Iterable[str]:
    bottom = HEIGHT - BOTTOM
    for tick in y_ticks:
        yield f'<path class="grid" d="M{x.start:.1f} {y(tick)}H{x.end}"/>'
        yield _text(x.start - 6, y(tick) + 4, plain(tick), "end")
    x_ticks = ticks(x.low, x.high, 6, fours=fours)
    room = max((len(plain(tick)) for tick in x_ticks), default=1) * LETTER + 8
    last = -room
    for tick in x_ticks:
        yield f'<path class="grid" d="M{x(tick)} {TOP}V{bottom}"/>'
        # A number that would run into the one before it is left out.
        if x(tick) - last >= room:
            half = LETTER * len(plain(tick)) / 2
            yield _text(min(x(tick), WIDTH - half), bottom + 16, plain(tick), "middle")
            last = x(tick)
    yield f'<path class="axis" d="M{x.start:.1f} {TOP}V{bottom}H{x.end}"/>'
    yield _text((x.start + x.end) / 2, HEIGHT - 6, plot.axes[axis], "middle")
    yield _text(2, 13, plot.y, "start")


def _floor(band: float, x: Scale, y: Scale) -> Iterable[str]:
    """Shade what lies below the reference's own error."""
    top, bottom = y(band), HEIGHT - BOTTOM
    yield (
        f'<rect class="floor" x="{x.start:.1f}" y="{top}" width="{x.end - x.start:.1f}"'
        f' height="{bottom - top:.1f}"/>'
    )
    inside = bottom - top >= 16
    yield _text(x.start + 5, top + 12 if inside else top - 4, "error of the reference", "start")


def _slope(plot: Plot, axis: str, x: Scale, y: Scale) -> Iterable[str]:
    """Draw a line of order -1/2 that lies above every line and next to one."""
    measured = [
        (place, error)
        for series in plot.series
        if not series.predicted
        for place, error in zip(series.x[axis], series.y, strict=True)
    ]
    factor = 1.2 * max(error * sqrt(place) for place, error in measured)
    # From where it comes in at the top, or at the left.
    first = max(min(place for place, _ in measured), (factor / y.high) ** 2)
    last = max(place for place, _ in measured)
    if first >= last:
        return

    def point(place: float) -> tuple[float, float]:
        return x(place), y(factor / sqrt(place))

    start, end = point(first), point(last)
    yield f'<path class="slope" d="M{start[0]} {start[1]}L{end[0]} {end[1]}"/>'
    middle = point(first**0.45 * last**0.55)
    words = "order -1/2"
    yield _text(
        min(middle[0] + 4, WIDTH - LETTER * len(words)), max(middle[1] - 5, TOP + 8), words, "start"
    )


def _line(plot: Plot, axis: str, series: Series, x: Scale, y: Scale) -> str:
    style = series.style % STYLES
    places = [(x(a), y(b)) for a, b in zip(series.x[axis], series.y, strict=True)]
    path = "M" + "L".join(f"{a} {b}" for a, b in places)
    drawn = [f'<path class="line{" predicted" * series.predicted}" d="{path}"/>']
    if series.limit:
        drawn.append(f'<path class="limit" d="M{x.start:.1f} {y(series.limit)}H{x.end}"/>')
    if not series.predicted:
        drawn += [
            f'<path class="mark" d="{MARKS[style]}" transform="translate({a} {b})"'
            f' data-x="{a}" data-y="{b}" data-values="{escape(values(plot, series, number))}"/>'
            for number, (a, b) in enumerate(places)
        ]
    return f'<g class="curve s{style}">{"".join(drawn)}</g>'


def _text(x: float, y: float, words: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(words)}</text>'
