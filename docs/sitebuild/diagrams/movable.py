"""Drawings whose points have names, so that readers can drag some of them (`_static/drag.js`).

A drawing has a *model*: where its points lie and which numbers it shows, for given values of what can be dragged. It is
written twice: here, by the course's own functions, and in JavaScript (`_static/drag_models.js`). A test holds that both
have the same points and numbers. What is drawn is written once: an element says in ``data-at`` at which points it lies.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from sitebuild.diagrams.canvas import Canvas, _short

Values = Mapping[str, float]


@dataclass(frozen=True)
class Model:
    """A drawing for given values.

    Attributes
    ----------
    points : (2,) each, or (2, N) for curves and rows of points
    numbers : what sentences say, and the radii of circles
    """

    points: dict[str, Any]
    numbers: dict[str, float]


@dataclass(frozen=True)
class Value:
    """What can be changed: from `low` to `high`, by the arrow keys in steps."""

    low: float
    high: float
    start: float
    step: float


@dataclass(frozen=True)
class Handle:
    """A point that can be dragged.

    Attributes
    ----------
    name : for those who hear it
    point : of the model
    keys : the values that the arrow keys change: to the right, and upwards where there are two
    says : the values in words, as a template
    """

    name: str
    point: str
    keys: tuple[str, ...]
    says: str


@dataclass(frozen=True)
class Movement:
    """What moves in a figure.

    Attributes
    ----------
    name : of the model in `_static/drag_models.js`
    model : the same model
    values : by their names
    handles : in the order of the Tab key
    sentence : what the numbers are, as a template: ``{width:.2f}``
    """

    name: str
    model: Callable[[Values], Model]
    values: dict[str, Value]
    handles: tuple[Handle, ...]
    sentence: str

    @property
    def start(self) -> dict[str, float]:
        """The values of the drawing at rest."""
        return {name: value.start for name, value in self.values.items()}

    @property
    def attributes(self) -> str:
        """What the script has to know, as attributes of the figure."""
        values = {n: [v.low, v.high, v.start, v.step] for n, v in self.values.items()}
        handles = [
            {"name": h.name, "point": h.point, "keys": h.keys, "says": h.says} for h in self.handles
        ]
        pairs = {"values": values, "handles": handles}
        written = "".join(f' data-{key}="{escape(json.dumps(v))}"' for key, v in pairs.items())
        return f' data-model="{self.name}"{written}'


def shown(number: float, digits: int) -> str:
    """A number as the script writes it."""
    return f"{number:.{digits}f}" if np.isfinite(number) else "∞"


class Movable(Canvas):
    """A drawing of a model's points; what is given points as such, not by their names, stays where it is.

    Parameters
    ----------
    model : at rest
    width, height, window, margin, stretch : as of Canvas
    """

    def __init__(self, model: Model, *args: Any, **more: Any) -> None:
        super().__init__(*args, **more)
        self.model = model

    @property
    def frame(self) -> str:
        """The way from the plane to the viewBox: its middle, the scales, half the size."""
        scales = self.scale * self.direction
        numbers = (*self.middle, *scales, self.width / 2, self.height / 2)
        return " ".join(f"{number:.9g}" for number in numbers)

    def line(self, a: ArrayLike | str, b: ArrayLike | str, kind: str = "ink") -> None:
        """A line between two points."""
        super().line(self._point(a), self._point(b), kind)
        self._bind(-1, a, b)

    def path(self, points: ArrayLike | str, kind: str = "ink", closed: bool = False) -> None:
        """As of Canvas; points may be names with spaces between."""
        if not isinstance(points, str):
            return super().path(points, kind, closed)
        rows = [np.reshape(self._point(name), (2, -1)) for name in points.split()]
        super().path(np.concatenate(rows, axis=1), kind, closed)
        return self._bind(-1, points)

    def arrow(
        self, a: ArrayLike | str, b: ArrayLike | str, kind: str = "ink", head: float = 7
    ) -> None:
        """An arrow from a to b."""
        super().arrow(self._point(a), self._point(b), kind, head)
        if isinstance(a, str):
            side = 0.38 * head
            self._bind(-2, a, f"{b}/{a}/{0.7 * head:g}/0")
            self._bind(-1, b, f"{b}/{a}/{head:g}/{side:g}", f"{b}/{a}/{head:g}/{-side:g}")

    def circle(self, centre: ArrayLike | str, radius: float | str, kind: str = "ink") -> None:
        """A circle; its radius may be one of the model's numbers."""
        named = isinstance(radius, str)
        super().circle(
            self._point(centre),
            self.model.numbers[radius] if isinstance(radius, str) else radius,
            kind,
        )
        self._bind(-1, centre)
        if named:
            self.elements[-1].set("data-radius", str(radius))

    def dot(
        self, point: ArrayLike | str, kind: str = "ink", size: float = 2.8, opacity: float = 1
    ) -> None:
        """A point, or each point of a row."""
        spots = np.reshape(self._point(point), (2, -1))
        super().dot(spots, kind, size, opacity)
        if isinstance(point, str):
            many = spots.shape[1]
            for k in range(many):
                self._bind(k - many, point if many == 1 else f"{point}:{k}")

    def lines(self, a: str, b: str, kind: str = "ink") -> None:
        """A line from a point to each point of a row, or from row to row."""
        ends = np.reshape(self._point(b), (2, -1))
        starts = np.broadcast_to(np.reshape(self._point(a), (2, -1)), ends.shape)
        single = np.ndim(self._point(a)) == 1
        for k, (p, q) in enumerate(zip(starts.T, ends.T, strict=True)):
            super().line(p, q, kind)
            self._bind(-1, a if single else f"{a}:{k}", f"{b}:{k}")

    def length(
        self,
        a: ArrayLike | str,
        b: ArrayLike | str,
        text: str,
        away: float = 10,
        gap: float = 5,
    ) -> None:
        """How long a to b is."""
        before = len(self.elements)
        super().length(self._point(a), self._point(b), text, away, gap)
        if isinstance(a, str):
            self._bind(before, f"{a}/{b}/0/{away:g}", f"{b}/{a}/0/{-away:g}")
            # Seen from b, the left of a is the right.
            for k, (p, q, sign) in enumerate(((a, b, 1), (b, a, -1)), 1):
                near, far = (sign * (away + half) for half in (-3.5, 3.5))
                self._bind(before + k, f"{p}/{q}/0/{near:g}", f"{p}/{q}/0/{far:g}")
            if text:
                self._bind(before + 3, f"{a}/{b}/50%/{away:g}")

    def label(
        self, point: ArrayLike | str, text: str, side: str = "n", gap: float = 6, kind: str = ""
    ) -> None:
        """Words that stay beside a point."""
        super().label(self._point(point), text, side, gap, kind)
        self._bind(-1, point)

    def _point(self, point: ArrayLike | str) -> Any:
        return self.model.points[point] if isinstance(point, str) else point

    def _bind(self, element: int, *points: ArrayLike | str) -> None:
        """Say at which points an element lies; points without a name are written as they are."""
        if any(isinstance(point, str) for point in points):
            spots = [p if isinstance(p, str) else "=" + _numbers(p) for p in points]
            self.elements[element].set("data-at", " ".join(spots))


def _numbers(point: ArrayLike) -> str:
    return ",".join(_short(float(v), 4) for v in np.asarray(point, float))
