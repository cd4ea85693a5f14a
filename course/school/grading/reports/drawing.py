"""Figures of any kind drawn, whichever report shows them: pictures as pixels, points and histograms as SVG.

Their arrays come from checks, so shapes and dtypes are right; the numbers may be any, for they come from students.
An SVG element takes the page's own colour of text. Each plot is a matplotlib figure of its own: nothing is shared
between threads, and no global setting is changed.
"""

import json
import re
import zlib
from base64 import b64encode
from collections.abc import Mapping
from dataclasses import dataclass, replace
from io import BytesIO, StringIO
from typing import Any, NamedTuple

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure as Canvas
from matplotlib.ticker import LogLocator
from numpy.typing import NDArray
from PIL import Image

from course.engine.core.types import Floats64
from course.engine.formats.pictures.display import linear_to_srgb8
from course.school.grading.checks.check import Array, Figure
from course.school.grading.checks.result import Result

WORST = 12
"""Pixels across the enlarged region."""

LARGEST = 256
"""Pixels of the longer side that are drawn; of larger pictures every second, third, ... pixel."""

NOISE_LIMIT = 5.0
"""Where the colours of the difference over the noise end."""

FAINT = 0.01
"""Difference that is hardly seen, as a share of the reference's brightest value (of white, where that is brighter)."""

BROKEN = (255, 0, 255)
"""sRGB of pixels that are NaN or infinite."""

# sRGB; blue for less and red for more is told apart with any colour vision.
_DIVERGING = np.array(
    [(5, 48, 97), (67, 147, 195), (247, 247, 247), (214, 96, 77), (103, 0, 31)], np.float64
)

YOURS, EXPECTED = "#d9622b", "#3f8fc9"
"""Readable on white and on black, and told apart with any colour vision."""

ALIKE = 0.05
"""Values are alike if their shares below any number differ by less: nobody sees it in their histograms."""

MOST_POINTS = 2500
FURTHEST = 1e12
"""Beyond this nothing is drawn: the axes could not be labelled."""

_INK = "#123456"
"""Becomes the colour of the text around the plot."""

# In the order in which they are looked at.
_LABELS = {"expected": "The reference", "yours": "Yours"}
_TITLES = {"expected": "Reference", "yours": "Yours"}


class ColourScale(NamedTuple):
    """The meaning of a map's colours: what its two ends stand for; the middle is 0."""

    low: str
    high: str


@dataclass(frozen=True)
class Panel:
    """One picture or plot.

    Attributes
    ----------
    title, caption : stand beside it
    alt : says it to those who don't see it
    pixels : (H, W, 3) sRGB codes of a picture, to be enlarged without smoothing; None for a plot
    svg : a plot's ``<svg>`` element, made here from numbers only
    scale : of a map's colours
    """

    title: str
    alt: str
    caption: str = ""
    pixels: NDArray[np.uint8] | None = None
    svg: str = ""
    scale: ColourScale | None = None

    def data_uri(self, factor: int = 1) -> Markup:
        """The picture or plot as a ``data:`` address, which templates print whole, however long it is.

        A picture's pixels become squares of ``factor`` pixels.
        """
        if self.pixels is None:
            start = (
                '<svg xmlns="http://www.w3.org/2000/svg" '
                'xmlns:xlink="http://www.w3.org/1999/xlink" style="color:#222"'
            )
            svg = self.svg.replace("<svg", start, 1)
            return data_uri("svg+xml", svg.encode())
        buffer = BytesIO()
        pixels = self.pixels.repeat(factor, axis=0).repeat(factor, axis=1)
        Image.fromarray(pixels).save(buffer, "png", optimize=True)
        return data_uri("png", buffer.getvalue())

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture; of a plot, in points."""
        if self.pixels is None:
            found = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', self.svg)
            return (round(float(found[1])), round(float(found[2]))) if found else (0, 0)
        return self.pixels.shape[1], self.pixels.shape[0]


def data_uri(kind: str, content: bytes) -> Markup:
    """A file of a kind of picture, such as "png", as an address; base64 needs no escaping."""
    return Markup(f"data:image/{kind};base64,{b64encode(content).decode('ascii')}")


@dataclass(frozen=True)
class Drawing:
    """A figure, drawn.

    Attributes
    ----------
    title : of the figure
    panels : in the order in which they are looked at; none where nothing could be drawn
    notes : sentences about what the panels can't show
    view : the place of a view of rays in an HTML page with the script for it; empty where there is none
    """

    title: str
    panels: tuple[Panel, ...] = ()
    notes: tuple[str, ...] = ()
    view: str = ""


def draw(figure: Figure, *, noisy: bool = True) -> Drawing:
    """Draw a figure, whatever its arrays hold: they come from students.

    Returns Drawing: Without panels, but with a sentence, where nothing can be drawn.

    ``noisy``: whether right functions may differ by noise; of others no difference is measured by it
    """
    try:
        if figure.kind == "pictures":
            return draw_pictures(figure, noisy=noisy)
        return _BY_KIND[figure.kind](figure)
    except Exception as error:  # noqa: BLE001 - a report without this figure is better than no report
        return Drawing(figure.title, notes=(f"This can't be drawn: {error}.",))


def is_noisy(result: Result) -> bool:
    """Whether a right function in its place may give another picture: it draws, or gets random numbers."""
    from course.school.grading.checks.declare import declaration

    # Of all modules together some do.
    declared = declaration(result.module, result.function)
    return declared is None or any(one.name in ("u", "rng") for one in declared.arguments)


def reworded(drawing: Drawing, words: Mapping[str, str]) -> Drawing:
    """The same drawing for other readers: each of the words becomes another, the first ones first."""

    def said(text: str) -> str:
        for old, new in words.items():
            text = text.replace(old, new)
        return text

    panels = tuple(
        replace(one, title=said(one.title), alt=said(one.alt), caption=said(one.caption))
        for one in drawing.panels
    )
    return replace(drawing, panels=panels, notes=tuple(map(said, drawing.notes)))


def draw_pictures(figure: Figure, *, noisy: bool = True) -> Drawing:
    """Draw ``yours`` beside ``expected``, both (3, H, W) linear RGB, where there are two, with what tells them apart.

    That is the signed difference, the difference over the noise if it is ``noisy``, and the worst region.
    """
    notes: list[str] = []
    pictures = {name: _picture(array, _LABELS[name], notes) for name, array in _in_order(figure)}
    panels = [_plain(picture, _TITLES[name]) for name, picture in pictures.items()]
    if len(pictures) == 2:
        panels += _compared(pictures["yours"], pictures["expected"], notes, noisy)
    return Drawing(figure.title, tuple(panels), tuple(notes))


def _picture(array: Array, label: str, notes: list[str]) -> Floats64:
    """The picture, or every so manieth pixel of a large one, each way."""
    step = -(-max(array.shape[1:]) // LARGEST)
    if step > 1:
        notes.append(f"{label} is {_size(array)} pixels large; one in {step} is drawn, each way.")
    picture = array[:, ::step, ::step].astype(np.float64)
    broken = int((~np.isfinite(picture)).any(axis=0).sum())
    if broken:
        of = picture.shape[1] * picture.shape[2]
        notes.append(f"{label} is NaN or infinite at {broken} of {of} pixels, painted magenta.")
    return picture


def _size(picture: Array) -> str:
    return f"{picture.shape[2]} × {picture.shape[1]}"


def _plain(picture: Floats64, title: str) -> Panel:
    size = _size(picture)
    return Panel(
        title,
        f"{title}: a picture of {size} pixels; {_brightness(picture)}.",
        f"{size} pixels, {_brightness(picture)}",
        _codes(picture),
    )


def _brightness(picture: Floats64) -> str:
    values = picture[np.isfinite(picture)]
    if not values.size:
        return "no finite value"
    # Mean of halves: a sum of the largest floats would overflow.
    return f"mean {2 * (values / (2 * values.size)).sum():.3g}"


def _codes(picture: Floats64) -> NDArray[np.uint8]:
    codes = linear_to_srgb8(np.clip(np.nan_to_num(picture), 0, 1).astype(np.float32))
    codes[~np.isfinite(picture).all(axis=0)] = BROKEN
    return codes


def _compared(yours: Floats64, expected: Floats64, notes: list[str], noisy: bool) -> list[Panel]:
    with np.errstate(all="ignore"):
        difference = yours - expected
    worst = _largest(difference)
    finite = np.isfinite(worst)
    if finite.all() and not worst.any():
        notes.append("The two pictures are equal to the last bit.")
        return []
    # As the checks do, so that their text and this region are about the same pixel.
    with np.errstate(all="ignore"):
        magnitude = np.where(finite, np.abs(difference).sum(axis=0), np.inf)
    row, column = (int(i) for i in np.unravel_index(magnitude.argmax(), magnitude.shape))
    largest, faint = float(np.abs(worst[finite]).max(initial=0.0)), _faint(expected)
    # What nobody sees is pale.
    scale = max(largest, faint)
    told = f"; the largest difference is {largest:.2g}" if largest < faint else ""
    panels = [
        Panel(
            "Signed difference",
            "Map of yours minus the reference. "
            f"The largest difference is at pixel ({column}, {row}).",
            "Yours minus the reference, of the colour that differs most: "
            f"blue where yours is darker, red where brighter. Colours end at ±{scale:.3g}{told}.",
            _map(worst, scale),
            scale=ColourScale(f"−{scale:.3g} darker", f"+{scale:.3g} brighter"),  # noqa: RUF001
        )
    ]
    if noisy:
        panels += _over_noise(difference, 0.1 * faint, notes)
    return panels + _enlarged(yours, expected, row, column)


def _faint(expected: Floats64) -> float:
    brightest = float(expected[np.isfinite(expected)].max(initial=0.0))
    return FAINT * min(brightest, 1.0) if brightest > 0 else FAINT


def _largest(values: Floats64) -> Floats64:
    """The value furthest from 0 of each pixel's three colours; NaN where any is not finite."""
    magnitude = np.where(np.isfinite(values), np.abs(values), np.inf)
    picked = np.take_along_axis(values, magnitude.argmax(axis=0)[None], axis=0)[0]
    return np.where(np.isfinite(values).all(axis=0), picked, np.nan)


def _map(values: Floats64, limit: float) -> NDArray[np.uint8]:
    """Diverging colours of (H, W) values from -limit to limit."""
    with np.errstate(all="ignore"):
        share = np.nan_to_num(values / limit) if limit > 0 else np.zeros_like(values)
    place = (np.clip(share, -1, 1) + 1) / 2 * (len(_DIVERGING) - 1)
    stops = np.arange(len(_DIVERGING))
    codes = np.stack([np.interp(place, stops, channel) for channel in _DIVERGING.T], axis=-1)
    codes[np.isnan(values)] = BROKEN
    result: NDArray[np.uint8] = np.rint(codes).astype(np.uint8)
    return result


def _over_noise(difference: Floats64, least: float, notes: list[str]) -> list[Panel]:
    """The map, if the noise is ``least`` [radiance] or more: rounding over rounding looks like a catastrophe."""
    noise = _noise(difference)
    if not least <= noise < np.inf:
        notes.append("There is no noise to speak of that the difference could be measured by.")
        return []
    with np.errstate(all="ignore"):
        largest = _largest(difference / noise)
    beyond = int((np.abs(largest[np.isfinite(largest)]) > 3).sum())
    panel = Panel(
        "Difference over the noise",
        f"Map of the difference over the noise; it is beyond 3 at {beyond} of {largest.size} pixels.",
        f"How many times the noise the difference is; beyond 3 at {beyond} of {largest.size} pixels. "
        f"The noise is not known; it is taken as {noise:.2g}, from the median absolute difference between each pixel's "
        f"difference and its neighbours'. Colours end at ±{NOISE_LIMIT:g}.",
        _map(largest, NOISE_LIMIT),
        scale=ColourScale(f"−{NOISE_LIMIT:g} or less", f"+{NOISE_LIMIT:g} or more"),  # noqa: RUF001
    )
    return [panel]


def _noise(difference: Floats64) -> float:
    """Standard deviation of a pixel's difference beside those of its neighbours; 0 or NaN where it can't be told."""
    padded = np.pad(difference, ((0, 0), (1, 1), (1, 1)), mode="edge")
    around = padded[:, :-2, 1:-1] + padded[:, 2:, 1:-1] + padded[:, 1:-1, :-2] + padded[:, 1:-1, 2:]
    with np.errstate(all="ignore"):
        fine = difference - around / 4
    fine = fine[np.isfinite(fine)]
    # 1.4826 turns a median absolute deviation into a standard one; the mean of four neighbours adds a quarter of
    # the variance.
    return 1.4826 * float(np.median(np.abs(fine))) / np.sqrt(1.25) if fine.size else 0.0


def _enlarged(yours: Floats64, expected: Floats64, row: int, column: int) -> list[Panel]:
    """The region around the worst pixel, of both pictures."""
    _, height, width = yours.shape
    top = max(0, min(row - WORST // 2, height - WORST))
    left = max(0, min(column - WORST // 2, width - WORST))
    region = np.s_[:, top : top + WORST, left : left + WORST]
    bottom, right = min(top + WORST, height) - 1, min(left + WORST, width) - 1
    place = f"columns {left} to {right}, rows {top} to {bottom}"
    return [
        Panel(
            f"{title}, the worst region",
            f"{title}, enlarged around pixel ({column}, {row}): {_rgb(picture, row, column)}.",
            f"{place}; pixel ({column}, {row}) is {_rgb(picture, row, column)}",
            _codes(picture[region]),
        )
        for title, picture in (("Reference", expected), ("Yours", yours))
    ]


def _rgb(picture: Floats64, row: int, column: int) -> str:
    return "(" + ", ".join(f"{value:.3g}" for value in picture[:, row, column]) + ")"


def draw_points(figure: Figure) -> Drawing:
    """Draw ``expected``, if they are there, and ``yours``, (2, N) in the unit square or disk."""
    sets: dict[str, Floats64] = {}
    notes: list[str] = []
    for name, array in _in_order(figure):
        label, step = _LABELS[name], -(-array.shape[1] // MOST_POINTS)
        if step > 1:
            notes.append(f"{label} has {array.shape[1]} points; one in {step} is drawn.")
        sets[name] = _within(array[:, ::step].astype(np.float64), label, "points", notes)
    # The reference if it is there, else the student's.
    disk = bool((next(iter(sets.values())) < 0).mean() > 0.05)
    low, high = _view(sets, -1.0 if disk else 0.0)
    panels = [
        _scatter(points, _TITLES[name], YOURS if name == "yours" else EXPECTED, disk, low, high)
        for name, points in sets.items()
    ]
    return Drawing(figure.title, tuple(panels), tuple(notes))


def _in_order(figure: Figure) -> list[tuple[str, Array]]:
    return [(name, figure.arrays[name]) for name in _TITLES if name in figure.arrays]


def _within(values: Floats64, label: str, what: str, notes: list[str]) -> Floats64:
    """The values along the last axis that can be drawn."""
    fine = (np.abs(np.nan_to_num(values, nan=np.inf)) < FURTHEST).reshape(-1, values.shape[-1])
    kept = fine.all(axis=0)
    if not kept.all():
        notes.append(
            f"{label} has {int((~kept).sum())} of {kept.size} {what} that are NaN, infinite or huge; "
            "they are left out."
        )
    if not kept.any():
        raise ValueError(f"{label} has no finite {what}")
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
    if not disk:
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
    """Draw how often the values of ``expected``, if they are there, and of ``yours`` occur, over the same axis.

    Where ``u`` is there and that doesn't tell the two apart, each value is drawn over its number.
    """
    graphs = _graphs(figure)
    if graphs and len(graphs.panels) > 1 and are_alike(*(array for _, array in _in_order(figure))):
        return graphs
    notes: list[str] = []
    sets = {
        name: _within(array.astype(np.float64).ravel(), _LABELS[name], "values", notes)
        for name, array in _in_order(figure)
    }
    low = min(float(values.min()) for values in sets.values())
    high = max(float(values.max()) for values in sets.values())
    if 0 < low < 0.1 * high:
        low = 0.0
    if low >= 0 and 0.5 < high <= 1:
        low, high = 0.0, 1.0
    if high - low < 1e-9 * max(abs(low), abs(high), 1e-30):
        low, high = low - 0.5 * max(1.0, abs(low)), high + 0.5 * max(1.0, abs(high))
    panels = tuple(
        _bars(
            values,
            _TITLES[name] if len(sets) > 1 else "How often each value occurs",
            YOURS if name == "yours" else EXPECTED,
            (low, high),
        )
        for name, values in sets.items()
    )
    if graphs and len(panels) == 1:
        panels += graphs.panels
    return Drawing(figure.title, panels, tuple(notes))


def are_alike(one: Array, other: Array) -> bool:
    """Whether histograms of the values look the same."""
    first, second = (np.sort(array.astype(np.float64), axis=None) for array in (one, other))
    values = np.concatenate((first, second))
    if not np.isfinite(values).all():
        return False
    below = [np.searchsorted(each, values, "right") / each.size for each in (first, second)]
    return bool(np.abs(below[0] - below[1]).max() < ALIKE)


def _graphs(figure: Figure) -> Drawing | None:
    """Each value of ``expected``, if they are there, and of ``yours`` over its ``u``; None without numbers u."""
    u = figure.arrays.get("u")
    sets = _in_order(figure)
    if u is None or any(array.shape != u.shape for _, array in sets):
        return None
    notes: list[str] = []
    points = {
        name: _within(np.stack((u, array)).astype(np.float64), _LABELS[name], "values", notes)
        for name, array in sets
    }
    low, high = _view(points, 0.0)
    panels = tuple(
        _graph(
            drawn,
            _TITLES[name] if len(sets) > 1 else "Each value over its u",
            YOURS if name == "yours" else EXPECTED,
            low,
            high,
        )
        for name, drawn in points.items()
    )
    return Drawing(figure.title, panels, tuple(notes))


def _graph(points: Floats64, title: str, color: str, low: Floats64, high: Floats64) -> Panel:
    u, values = points
    ends = "; ".join(f"{values[k]:.3g} at u = {u[k]:.3g}" for k in (u.argmin(), u.argmax()))
    canvas, axes = _axes((4.2, 2.9))
    axes.scatter(u, values, s=5, color=color, lw=0, rasterized=True)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_xlabel("u")
    axes.set_ylabel("value")
    return Panel(title, f"{title}: {u.size} values over u; {ends}.", ends, svg=_svg(canvas))


def _bars(values: Floats64, title: str, color: str, ends: tuple[float, float]) -> Panel:
    told = (
        f"{values.size} values from {values.min():.4g} to {values.max():.4g}, "
        f"mean {values.mean():.4g}"
    )
    canvas, axes = _axes((4.2, 2.9))
    bins = int(np.clip(np.sqrt(values.size), 8, 40))
    axes.hist(values, bins, range=ends, density=True, color=color)
    axes.set_xlim(*ends)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("value")
    axes.set_ylabel("density")
    return Panel(title, f"Histogram: {told}.", told, svg=_svg(canvas))


def draw_curve(points: tuple[tuple[int, float], ...]) -> str:
    """Errors [radiance] over samples a pixel as SVG, both axes logarithmic, beside n^-1/2 from the first one on."""
    canvas, axes = _axes((3.6, 3.0))
    counts, errors = zip(*points, strict=True)
    if min(errors) > 0:
        axes.set_yscale("log")
    axes.set_xscale("log")
    axes.plot(counts, [errors[0] * (n / counts[0]) ** -0.5 for n in counts], ":", color=_INK)
    axes.plot(counts, errors, "o-", color="#2f7fd0")
    axes.set_xticks(counts, map(str, counts))
    axes.minorticks_off()
    if axes.get_yscale() == "log":
        # matplotlib itself labels powers of ten only, of which there may be one or none.
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter("{x:g}")
    axes.set_xlabel("samples a pixel")
    axes.set_ylabel("error [radiance]")
    return _svg(canvas)


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


def draw_rays(figure: Figure) -> Drawing:
    """The rays of a pixel: sentences that say what is different, and a view of both."""
    from course.engine.recording.pair import told
    from course.engine.recording.view import element

    data = json.loads(zlib.decompress(figure.arrays["data"].tobytes()))
    return Drawing(figure.title, notes=tuple(told(data)), view=element(data))


_BY_KIND = {
    "pictures": draw_pictures,
    "points": draw_points,
    "histogram": draw_histogram,
    "rays": draw_rays,
}
