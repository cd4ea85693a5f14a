"""What a drawn figure consists of, whichever report shows it."""

from __future__ import annotations

import re
from base64 import b64encode
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from course.grading.checks.check import Array


class NotDrawable(Exception):  # noqa: N818 - it is no error of the program
    """A figure's arrays are nothing that can be drawn; the message says why, to the student."""


@dataclass(frozen=True)
class Scale:
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
    scale: Scale | None = None

    def data_uri(self, factor: int = 1) -> str:
        """The picture or plot as a ``data:`` address; a picture's pixels become squares of ``factor`` pixels."""
        if self.pixels is None:
            start = (
                '<svg xmlns="http://www.w3.org/2000/svg" '
                'xmlns:xlink="http://www.w3.org/1999/xlink" style="color:#222"'
            )
            svg = self.svg.replace("<svg", start, 1)
            return "data:image/svg+xml;base64," + b64encode(svg.encode()).decode("ascii")
        buffer = BytesIO()
        pixels = self.pixels.repeat(factor, axis=0).repeat(factor, axis=1)
        Image.fromarray(pixels).save(buffer, "png", optimize=True)
        return "data:image/png;base64," + b64encode(buffer.getvalue()).decode("ascii")

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture; of a plot, in points."""
        if self.pixels is None:
            found = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', self.svg)
            return (round(float(found[1])), round(float(found[2]))) if found else (0, 0)
        return self.pixels.shape[1], self.pixels.shape[0]


@dataclass(frozen=True)
class Drawing:
    """A figure, drawn.

    Attributes
    ----------
    title : of the figure
    panels : in the order in which they are looked at; none where nothing could be drawn
    notes : sentences about what the panels can't show
    """

    title: str
    panels: tuple[Panel, ...] = ()
    notes: tuple[str, ...] = ()


def numbers(array: Any, name: str) -> Array:
    """The array if it holds real numbers.

    Raises
    ------
    NotDrawable
    """
    found = np.asarray(array)
    if found.dtype.kind not in "fiub":
        raise NotDrawable(f"{name} holds {found.dtype} values, not real numbers")
    if not found.size:
        raise NotDrawable(f"{name} is empty: its shape is {found.shape}")
    return found
