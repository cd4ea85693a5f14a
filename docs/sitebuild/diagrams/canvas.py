"""What figures are drawn with: lines, arrows, angles, surfaces and labels, as the elements of an SVG.

Nothing here has a colour. Elements have classes, and `_static/diagrams.css` gives these the colours of the page's
scheme: "ink" and "faint" lines, "accent" for what the figure is about, "wash" and "shade" for surfaces; "thick", "thin"
and "dashed" change a line.
"""

import math
import re
from collections.abc import Iterable, Sequence
from xml.etree import ElementTree as ET

import numpy as np
from numpy.typing import ArrayLike, NDArray

Pair = NDArray[np.float64]

TEXT, SYMBOL, SMALL = 12.0, 14.5, 11.0
"""Sizes of words, of symbols and of their indices, in units of the viewBox; the page shows a unit "
"as a pixel or more."""

SIDES = {
    "n": (0, -1),
    "s": (0, 1),
    "e": (1, 0),
    "w": (-1, 0),
    "ne": (0.7, -0.7),
    "nw": (-0.7, -0.7),
    "se": (0.7, 0.7),
    "sw": (-0.7, 0.7),
    "c": (0, 0),
}
"""Where a label stands from its point, as on a map."""


class Canvas:
    """One drawing.

    Parameters
    ----------
    width, height : of the viewBox
    window : (x0, x1, y0, y1)
        What of the plane is seen, at one scale, in the middle; y upwards, or downwards where y0 > y1.
    margin : on all sides, in units of the viewBox
    stretch : whether x and y have a scale each and fill the room, as plots do
    """

    def __init__(
        self,
        width: float,
        height: float,
        window: tuple[float, float, float, float] | None = None,
        margin: float = 0,
        stretch: bool = False,
    ) -> None:
        self.width, self.height = width, height
        x0, x1, y0, y1 = window or (0, width, height, 0)
        scales = np.array([(width - 2 * margin) / (x1 - x0), (height - 2 * margin) / (y0 - y1)])
        self.scale = 1.0 if stretch else float(np.abs(scales).min())
        self.direction = scales if stretch else np.sign(scales)
        self.middle = np.array([x0 + x1, y0 + y1]) / 2
        self.elements: list[ET.Element] = []
        self.boxes: list[tuple[float, float, float, float, str]] = []

    def at(self, point: ArrayLike) -> Pair:
        """Where a point of the plane, or (2, N) points, lie in the viewBox."""
        points = np.asarray(point, float)
        column = (2,) + (1,) * (points.ndim - 1)
        here = (points - self.middle.reshape(column)) * self.scale
        centre = np.array([self.width, self.height]).reshape(column) / 2
        return here * self.direction.reshape(column) + centre

    def away(self, point: ArrayLike, dx: float, dy: float) -> Pair:
        """The point of the plane that lies so many units of the viewBox to the right and down."""
        return np.asarray(point, float) + np.array([dx, dy]) / self.direction / self.scale

    # Lines

    def line(self, a: ArrayLike, b: ArrayLike, kind: str = "ink") -> None:
        """A line between two points."""
        (x1, y1), (x2, y2) = self.at(a), self.at(b)
        self._add("line", kind, x1=x1, y1=y1, x2=x2, y2=y2)

    def path(self, points: ArrayLike, kind: str = "ink", closed: bool = False) -> None:
        """A line through (2, N) points, or the polygon of them."""
        spots = " ".join(f"{_short(x)},{_short(y)}" for x, y in self.at(points).T)
        self._add("polygon" if closed else "polyline", kind, points=spots)

    def arrow(self, a: ArrayLike, b: ArrayLike, kind: str = "ink", head: float = 7) -> None:
        """An arrow from a to b."""
        start, tip = self.at(a), self.at(b)
        way = tip - start
        length = float(np.hypot(*way))
        if length == 0:
            return
        way /= length
        head = min(head, length)
        side = np.array([-way[1], way[0]]) * head * 0.38
        base = tip - way * head
        end = base + way * head * 0.3
        self._add("line", kind, x1=start[0], y1=start[1], x2=end[0], y2=end[1])
        corners = " ".join(f"{_short(x)},{_short(y)}" for x, y in (tip, base + side, base - side))
        self._add("polygon", f"head {kind}", points=corners)

    def rectangle(
        self, lo: ArrayLike, hi: ArrayLike, kind: str = "ink", opacity: float = 1
    ) -> None:
        """The rectangle between two opposite corners."""
        a, b = self.at(lo), self.at(hi)
        (x, y), (width, height) = np.minimum(a, b), np.abs(b - a)
        more = {} if opacity == 1 else {"fill-opacity": _short(opacity, 3)}
        self._add("rect", kind, x=x, y=y, width=width, height=height, **more)

    def grid(
        self, lo: ArrayLike, hi: ArrayLike, columns: int, rows: int, kind: str = "faint"
    ) -> None:
        """The lines between the cells of a rectangle."""
        (x0, y0), (x1, y1) = np.asarray(lo, float), np.asarray(hi, float)
        for x in np.linspace(x0, x1, columns + 1)[1:-1]:
            self.line((x, y0), (x, y1), kind)
        for y in np.linspace(y0, y1, rows + 1)[1:-1]:
            self.line((x0, y), (x1, y), kind)

    def circle(self, centre: ArrayLike, radius: float, kind: str = "ink") -> None:
        """A circle, its radius in units of the plane."""
        x, y = self.at(centre)
        self._add("circle", kind, cx=x, cy=y, r=radius * self.scale)

    def dot(
        self, point: ArrayLike, kind: str = "ink", size: float = 2.8, opacity: float = 1
    ) -> None:
        """A point, or (2, N) points, of a size in units of the viewBox; "open" ones are rings."""
        more = {} if opacity == 1 else {"fill-opacity": _short(opacity, 3)}
        for x, y in self.at(point).reshape(2, -1).T:
            self._add("circle", f"dot {kind}", cx=x, cy=y, r=size, **more)

    def cross(self, point: ArrayLike, kind: str = "faint", size: float = 3) -> None:
        """An x at a point, or at (2, N) points."""
        for x, y in self.at(point).reshape(2, -1).T:
            for way in (1, -1):
                self._add(
                    "line", kind, x1=x - size, y1=y - way * size, x2=x + size, y2=y + way * size
                )

    # Marks

    def surface(self, a: ArrayLike, b: ArrayLike, kind: str = "ink", depth: float = 6) -> None:
        """A surface seen from its edge: a line, hatched on the right of who walks from a to b."""
        start, end = self.at(a), self.at(b)
        length = float(np.hypot(*(end - start)))
        way = (end - start) / length
        inward = np.array([-way[1], way[0]])
        marks = []
        for s in np.arange(depth, length + depth / 2, depth):
            p = start + way * min(s, length)
            q = p + (inward - way) * depth
            marks.append(f"M{_short(p[0])} {_short(p[1])}L{_short(q[0])} {_short(q[1])}")
        self._add("path", "faint thin", d="".join(marks))
        self._add("line", kind, x1=start[0], y1=start[1], x2=end[0], y2=end[1])

    def angle(
        self,
        corner: ArrayLike,
        a: ArrayLike,
        b: ArrayLike,
        text: str = "",
        radius: float = 22,
        kind: str = "ink thin",
        gap: float = 10,
    ) -> None:
        """The arc from the direction of a to that of b, with its name; the radius in units of the viewBox."""
        c = self.at(corner)
        first, second = (math.atan2(*(self.at(p) - c)[::-1]) for p in (a, b))
        turn = (second - first + math.pi) % (2 * math.pi) - math.pi
        steps = first + turn * np.linspace(0, 1, 13)
        spots = c[:, None] + radius * np.stack((np.cos(steps), np.sin(steps)))
        points = " ".join(f"{_short(x)},{_short(y)}" for x, y in spots.T)
        self._add("polyline", kind, points=points)
        if text:
            middle = first + turn / 2
            where = c + (radius + gap) * np.array([math.cos(middle), math.sin(middle)])
            self._write(where, text, (0, 0), 0)

    def right_angle(self, corner: ArrayLike, a: ArrayLike, b: ArrayLike, size: float = 8) -> None:
        """The little square of a right angle."""
        c = self.at(corner)
        ways = [(self.at(p) - c) / np.hypot(*(self.at(p) - c)) * size for p in (a, b)]
        spots = (c + ways[0], c + ways[0] + ways[1], c + ways[1])
        points = " ".join(f"{_short(x)},{_short(y)}" for x, y in spots)
        self._add("polyline", "ink thin", points=points)

    def length(
        self, a: ArrayLike, b: ArrayLike, text: str, away: float = 10, gap: float = 5
    ) -> None:
        """How long a to b is: a line with two ends beside them, and its name.

        It stands on the left of who walks from a to b, so many units of the viewBox away; on the right if ``away`` is
        negative. The name stands on its far side.
        """
        start, end = self.at(a), self.at(b)
        way = (end - start) / np.hypot(*(end - start))
        out = np.array([way[1], -way[0]])
        start, end = start + out * away, end + out * away
        self._add("line", "ink thin", x1=start[0], y1=start[1], x2=end[0], y2=end[1])
        for p in (start, end):
            p, q = p - out * 3.5, p + out * 3.5
            self._add("line", "ink thin", x1=p[0], y1=p[1], x2=q[0], y2=q[1])
        if text:
            side = out * math.copysign(1, away)
            self._write((start + end) / 2, text, tuple(side), gap)

    # Words

    def label(
        self, point: ArrayLike, text: str, side: str = "n", gap: float = 6, kind: str = ""
    ) -> None:
        """Words beside a point; symbols stand between dollars, as in ``$x_0$``."""
        self._write(self.at(point), text, SIDES[side], gap, kind)

    def _write(
        self,
        where: Pair,
        text: str,
        side: tuple[float, ...],
        gap: float,
        kind: str = "",
    ) -> None:
        runs = list(_runs(text))
        width = sum(_width(words, size) for words, _, size, _ in runs)
        tall = max(size for _, _, size, _ in runs)
        x, y = where + np.array(side) * gap
        # A label beside its point begins or ends there; one above or below is centred on it.
        left = x - width * (1 - math.copysign(min(1, abs(side[0]) * 2), side[0])) / 2
        baseline = y + tall * (0.36 + 0.36 * math.copysign(min(1, abs(side[1]) * 1.4), side[1]))
        if side[1] < 0:
            baseline = y + tall * 0.36 * (1 - min(1, abs(side[1]) * 1.4)) - 0.5
        element = self._add("text", f"label {kind}".strip(), x=left, y=baseline)
        lowered = 0.0
        for words, name, _, drop in runs:
            run = ET.SubElement(element, "tspan", {"class": name} if name else {})
            if drop != lowered:
                run.set("dy", _short(drop - lowered))
            run.text, lowered = words, drop
        top = baseline - tall * 0.75 - (4 if any(run[3] < 0 for run in runs) else 0)
        bottom = baseline + tall * 0.2 + (3 if any(run[3] > 0 for run in runs) else 0)
        self.boxes.append((left, top, left + width, bottom, text))

    def _add(self, tag: str, kind: str, **values: float | str) -> ET.Element:
        element = ET.Element(tag, {"class": kind})
        for name, value in values.items():
            element.set(name, value if isinstance(value, str) else _short(float(value)))
        self.elements.append(element)
        return element


def _runs(text: str) -> Iterable[tuple[str, str, float, float]]:
    """The pieces of a label: words, their class, their size, and how far below the line they stand."""
    for k, piece in enumerate(text.split("$")):
        if k % 2 == 0:
            if piece:
                yield piece, "", TEXT, 0
            continue
        for match in re.finditer(
            r"([_^])(\{[^}]*\}|.)|([A-Za-zα-ωΑ-Ω]+)|([^_^A-Za-zα-ωΑ-Ω]+)", piece
        ):
            mark, index, letters, others = match.groups()
            if mark:
                inner = index.strip("{}")
                name = "index" if re.fullmatch(r"\d+", inner) else "index slanted"
                yield inner, name, SMALL, 4 if mark == "_" else -5
            elif letters:
                function = letters in ("cos", "sin", "max")
                yield letters, "symbol" if function else "symbol slanted", SYMBOL, 0
            else:
                yield others, "symbol", SYMBOL, 0


def _width(words: str, size: float) -> float:
    return size * sum(_advance(letter) for letter in words)


def _advance(letter: str) -> float:
    """About how wide a letter is, over its size; rather too much than too little."""
    if letter in "ijlI.,:;'|!()[]/ ft":
        return 0.33
    if letter in "mwMW%∞@→":
        return 0.9
    if letter in "r-":
        return 0.42
    return 0.7 if letter.isupper() else 0.58


def _short(value: float, digits: int = 1) -> str:
    text = f"{value:.{digits}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def between(a: ArrayLike, b: ArrayLike, share: float) -> Pair:
    """The point at a share of the way from a to b."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    return a + share * (b - a)


def meeting(a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike) -> Pair:
    """Where the line through a and b meets the line through c and d."""
    a, b, c, d = (np.asarray(p, float) for p in (a, b, c, d))
    s, _ = np.linalg.solve(np.stack((b - a, c - d), axis=1), c - a)
    return a + s * (b - a)


def moved(point: ArrayLike, dx: float, dy: float) -> Pair:
    """The point that lies so far from another one."""
    return np.asarray(point, float) + np.array([dx, dy])


def clipped(polygon: ArrayLike, lo: ArrayLike, hi: ArrayLike) -> NDArray[np.float64]:
    """What of a polygon (2, N) lies in a rectangle (Sutherland and Hodgman)."""
    points = list(np.asarray(polygon, float).T)
    for axis, border, sign in ((0, lo[0], 1), (0, hi[0], -1), (1, lo[1], 1), (1, hi[1], -1)):
        kept: list[NDArray[np.float64]] = []
        for a, b in zip(points, [*points[1:], *points[:1]], strict=True):
            inside = [sign * (p[axis] - border) >= 0 for p in (a, b)]
            if inside[0]:
                kept.append(a)
            if inside[0] != inside[1]:
                kept.append(a + (b - a) * (border - a[axis]) / (b[axis] - a[axis]))
        points = kept
    return np.stack(points, axis=1) if points else np.zeros((2, 0))


def unit(vector: ArrayLike) -> NDArray[np.float64]:
    """A vector's direction."""
    vector = np.asarray(vector, float)
    return vector / np.linalg.norm(vector)


def turned(degrees: float, length: float = 1) -> Pair:
    """A vector of the plane, so many degrees from x towards y."""
    return length * np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees))])


def columns(points: Sequence[ArrayLike]) -> NDArray[np.float64]:
    """Points as the columns of an array."""
    return np.stack([np.asarray(p, float) for p in points], axis=1)
