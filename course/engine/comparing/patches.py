"""Looks for a small square that differs evenly: by about as much in each of its pixels, while nothing around does.

Student's t of a square's differences, where the differences around count as its noise if they are larger. Of noise
whose sign is even a t is too large less often than Student's law says (Efron, "Student's t-test under symmetry
conditions", 1969). A firefly makes one pixel differ, and so a small t.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from course.engine.comparing.noise import DifferenceNoise, Strip, box, ring
from course.engine.comparing.windows import Window
from course.engine.core.types import Floats64


@dataclass(frozen=True)
class Patch:
    """Sides [pixels] of the square, of the one around it whose differences count, and of its middle, left out."""

    side: int
    around: int
    own: int


PATCHES = (Patch(3, 9, 5), Patch(5, 15, 9))
"""The middles cover the square wherever it overlaps one that differs."""


@dataclass(frozen=True)
class Even:
    """The patch of one size with the largest t; its p-value is corrected for the number of all."""

    p_value: float
    place: Window


def largest_t(
    part: Strip, own: slice, noise: DifferenceNoise, rounding: Floats64, least: float
) -> list[tuple[float, int, int]]:
    """Of the patches around pixels of some rows, for each of ``PATCHES``: t, the pixel's row in the part, its column.

    ``rounding``: by what differences may be off (H, W, 3); ``least``: noise that a pixel has at least.
    """
    found = []
    for patch in PATCHES:
        pixels = patch.side**2
        mean = box(part.d, patch.side)
        inner = np.maximum(box(part.d**2, patch.side) - mean**2, 0) * pixels / (pixels - 1)
        outer = ring(part.d**2, patch.around, patch.own)
        variance = np.maximum(np.maximum(inner, outer), noise.known)
        size = np.maximum(np.abs(mean) - box(rounding, patch.side), 0)
        t = size * patch.side / np.sqrt(variance + least**2)
        t = t.max(axis=2)[own]
        row, column = np.unravel_index(int(t.argmax()), t.shape)
        found.append((float(t[row, column]), int(row) + own.start, int(column)))
    return found


def evenest(
    largest: list[list[tuple[float, int, int]]], count: int, inflation: float
) -> Iterator[Even]:
    """The most significant patch of each size.

    ``largest``: `largest_t` of all strips, with rows of the picture; ``count``: pixels and channels;
    ``inflation``: by what the variance of sums is larger, for neighbours are alike.
    """
    from scipy.special import stdtr

    for patch, strips in zip(PATCHES, zip(*largest, strict=True), strict=True):
        t, row, column = max(strips)
        t /= np.sqrt(min(inflation, patch.side**2))
        p = min(1.0, count * 2 * float(stdtr(patch.side**2 - 1, -t)))
        corner = patch.side // 2
        yield Even(p, Window(max(column - corner, 0), max(row - corner, 0), patch.side, patch.side))
