"""Whether two figures can be told apart: by more than what the same figure differs by with other random numbers.

Means over square blocks are compared, in blocks of several sizes: an edge that has moved shows in small ones, points
that crowd only in large ones.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, product
from typing import Any

import numpy as np
from PIL import Image

from sitebuild.mistakes.look import SIZE

BLOCKS = (4, 8, 20, 40)
"""Pixels of a block's side."""

FAINTEST = 1.0
"""Difference of 256 codes, root mean square over a figure, that counts as noise where there is none."""

APART = 2.0
"""Two figures with at least this ratio are told apart."""

ALIKE = 1.5
"""With at most this ratio they are not."""

Array = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True)
class Difference:
    """How far two figures are apart, at the size of block that shows it best.

    Attributes
    ----------
    codes : root mean square difference of block means, of 256 codes
    noise : the largest that one of the figures differs by from itself with other random numbers; at least `FAINTEST`
    """

    codes: float
    noise: float

    @property
    def ratio(self) -> float:
        """How many times the noise."""
        return self.codes / self.noise

    @property
    def apart(self) -> bool:
        """Whether the figures can be told apart."""
        return self.ratio >= APART

    @property
    def alike(self) -> bool:
        """Whether they can't."""
        return self.ratio <= ALIKE


class Trials:
    """A figure, drawn several times with other random numbers; the first of them is what is shown.

    Attributes
    ----------
    shown : by size of block, its means as in ``block_means``
    noise : by size of block, how far two of the drawings are apart at most
    """

    def __init__(self, images: Sequence[Image.Image]) -> None:
        means = [[_means(codes, size) for size in BLOCKS] for codes in map(_codes, images)]
        self.shown = means[0]
        self.noise = [
            max((_distance(a, b) for a, b in combinations(drawn, 2)), default=0.0)
            for drawn in zip(*means, strict=True)
        ]


def difference(one: Trials, other: Trials) -> Difference:
    """Compare two figures."""
    found = [
        Difference(_distance(a, b), max(*noises, FAINTEST))
        for a, b, *noises in zip(one.shown, other.shown, one.noise, other.noise, strict=True)
    ]
    return max(found, key=lambda each: each.ratio)


def _distance(one: Array, other: Array) -> float:
    return float(np.sqrt(((one - other) ** 2).mean()))


def block_means(image: Image.Image, size: int) -> Array:
    """Means of a figure's blocks (rows, columns, 3), in codes, as it is on a page."""
    return _means(_codes(image), size)


def _codes(image: Image.Image) -> Array:
    shown = image.convert("RGB").resize(SIZE, Image.Resampling.LANCZOS)
    return np.asarray(shown, np.float64)


def _means(codes: Array, size: int) -> Array:
    width, height = SIZE
    blocks = codes.reshape(height // size, size, width // size, size, 3)
    means: Array = blocks.mean(axis=(1, 3))
    return means


PLACES = [
    f"{row} {column}".strip()
    for row, column in product(("upper", "", "lower"), ("left", "middle", "right"))
]


def described(image: Image.Image, right: Image.Image) -> str:
    """Where and how much a figure differs from the right one, for those who don't see it."""
    ours, theirs = (block_means(each, 4).mean(axis=2) for each in (image, right))
    off = ours - theirs
    changed = np.abs(off) > 4
    if not changed.any():
        return "It looks like the right one."
    rows, columns = (np.array_split(np.arange(n), 3) for n in off.shape)
    weights = [float(np.abs(off[np.ix_(r, c)]).sum()) for r, c in product(rows, columns)]
    brighter = off[changed].mean()
    change = (
        "darker" if brighter < -4 else "brighter" if brighter > 4 else "brighter here, darker there"
    )
    return (
        f"{100 * changed.mean():.0f}% of it differs from the right one, most in the "
        f"{PLACES[int(np.argmax(weights))]} part; there it is {change}."
    )
