"""Looks for spots of a few pixels that differ, while the rest of two pictures is the same but for noise.

How much most pixels of a small square agree to differ is divided by the differences around them. So one bright pixel, a
firefly, is no spot. What noise makes of that number nobody knows: its tail depends on the scene. But the picture itself
shows that tail. Where the largest numbers Z1 > Z2 > ... fall off as a power or faster, their spacings i log(Zi / Zi+1)
are at most exponential. One of them exceeds the mean of m later ones as often as Fisher's F(2, 2m) says, or less often
(Hill, "A simple general approach to inference about the tail of a distribution", 1975). A large spacing after the first
few numbers says that all of these stand out.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course.engine.comparing.noise import Strip, ring
from course.engine.comparing.windows import Window
from course.engine.core.types import Floats64

TAIL, FEWEST = 32, 8
"""Spacings of the largest numbers that are compared, and how many there must be."""

TOGETHER = 8
"""Spots at most that may stand out together."""

BRIGHTEST = 99.0
"""Percentile of the values, at twice which brighter ones are cut off: bright fireflies have longer tails."""

STEP = 0.15
"""Mean of log(Zi/Zi+1) that is assumed at least: where few samples bring light, numbers jump by whole samples."""


@dataclass(frozen=True)
class Shape:
    """Sides [pixels] of a spot's square, of the one around it whose differences count, and of its middle, left out."""

    side: int
    around: int
    own: int


SHAPES = (Shape(2, 9, 3), Shape(3, 9, 5), Shape(3, 15, 9))
"""The middle covers the largest spot that is found well: of 3, 5 and 9 pixels."""


@dataclass(frozen=True)
class Spot:
    """The one that stands out most; the p-value is corrected for the number of all."""

    p_value: float
    place: Window


@dataclass(frozen=True)
class Usual:
    """Of two whole pictures: where values are cut off, and the median of the differences around, for each shape."""

    top: float
    around: tuple[float, ...]


def usual(parts: Sequence[Strip]) -> Usual:
    """By some parts of two pictures."""
    values = [one[part.usable] for part in parts for one in (part.a, part.b)]
    top = 2 * float(np.percentile(np.concatenate(values), BRIGHTEST))
    medians = []
    for shape in SHAPES:
        around = np.concatenate([_around(_cut_off(part, top), shape).ravel() for part in parts])
        medians.append(float(np.median(around[around > 0])) if (around > 0).any() else 1.0)
    return Usual(top, tuple(medians))


def standing_out(part: Strip, known: Usual) -> list[Floats64]:
    """How much the square at each pixel (H, W) stands out, for each shape: at least 0; in any channel."""
    d = _cut_off(part, known.top)
    found = []
    for shape, least in zip(SHAPES, known.around, strict=True):
        size = _three_agree(d) if shape.side == 2 else _five_agree(d)
        # Where all is even the noise of elsewhere counts, by its median.
        found.append((size / np.maximum(_around(d, shape), least)).max(axis=2))
    return found


def _cut_off(part: Strip, top: float) -> Floats64:
    """Differences (H, W, 3), of what isn't too bright."""
    d: Floats64 = (np.minimum(part.a, top) - np.minimum(part.b, top)) * part.usable[..., None]
    return d


def _around(d: Floats64, shape: Shape) -> Floats64:
    return np.sqrt(ring(d * d, shape.around, shape.own))


def most_different_spot(z: Floats64, shape: Shape) -> Spot:
    """By how much the squares at each pixel (H, W) stand out; they are lost."""
    largest: list[tuple[float, Window]] = []
    apart = (shape.own + shape.side + 1) // 2 + 1
    for _ in range(TAIL + 1):
        row, column = map(int, np.unravel_index(int(z.argmax()), z.shape))
        if z[row, column] <= 0:
            break
        corner = shape.side // 2 if shape.side % 2 else 0
        place = Window(max(column - corner, 0), max(row - corner, 0), shape.side, shape.side)
        largest.append((float(z[row, column]), place))
        z[max(row - apart, 0) : row + apart + 1, max(column - apart, 0) : column + apart + 1] = 0
    if len(largest) <= FEWEST:
        return Spot(1.0, Window(0, 0, shape.side, shape.side))
    logs = np.log([size for size, _ in largest])
    spacings = np.arange(1, len(logs)) * (logs[:-1] - logs[1:])
    p = 1.0
    for first in range(min(TOGETHER, len(spacings) - FEWEST + 1)):
        others = spacings[first + 1 :]
        ratio = spacings[first] / max(float(others.mean()), STEP * (first + 1))
        # Half of the false alarms may be due to a spot alone.
        share = 2 * (TOGETHER - 1) if first else 2
        p = min(p, share * float((1 + ratio / len(others)) ** -len(others)))
    return Spot(p, largest[0][1])


def _three_agree(d: Floats64) -> Floats64:
    """By how much three pixels of a square of 2 x 2, to the right and down of each pixel, agree to differ."""
    upper, lower = (way(d[:-1], d[1:]) for way in (np.maximum, np.minimum))
    # Of the four, the two in the middle: three are at least as large as the lower of them, three at most as the higher.
    one = np.maximum(lower[:, :-1], lower[:, 1:])
    other = np.minimum(upper[:, :-1], upper[:, 1:])
    size = np.maximum(np.minimum(one, other), -np.maximum(one, other))
    return np.pad(np.maximum(size, 0), ((0, 1), (0, 1), (0, 0)))


def _five_agree(d: Floats64) -> Floats64:
    """By how much five pixels of the square of 3 x 3 around each one agree to differ: the size of its median."""
    padded = np.pad(d, ((1, 1), (1, 1), (0, 0)))
    columns = _in_order(padded[:-2], padded[1:-1], padded[2:])
    lows, middles, highs = ((one[:, :-2], one[:, 1:-1], one[:, 2:]) for one in columns)
    # Each column is in order, so the median of nine is the one of these three.
    low = np.maximum(np.maximum(*lows[:2]), lows[2])
    high = np.minimum(np.minimum(*highs[:2]), highs[2])
    size: Floats64 = np.abs(_in_order(low, _in_order(*middles)[1], high)[1])
    return size


def _in_order(a: Floats64, b: Floats64, c: Floats64) -> tuple[Floats64, Floats64, Floats64]:
    """The least, the middle and the largest of three."""
    low, high = np.minimum(a, b), np.maximum(a, b)
    return np.minimum(low, c), np.maximum(low, np.minimum(high, c)), np.maximum(high, c)
