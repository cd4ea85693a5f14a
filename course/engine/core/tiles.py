"""The work of a render: a tile is a rectangle of pixels that are rendered together; a pass is a range of their
samples.

Every pass but the last has PASS samples. So the film's sums grow in the same steps, and a pass takes the same memory,
for any number of samples per pixel. A sampler that isn't extensible has one pass.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from course.engine.core.rays import RAYS
from course.engine.core.samplers import Sampler
from course.engine.core.scene import Settings
from course.engine.core.types import Floats32, Words

PASS = 16
"""Samples per pixel in a whole pass of an extensible sampler."""

PAGE, APART = 1024, 64
"""Lengths in float32 values. Two addresses whose distance is a multiple of PAGE map to the same set of the first-level
cache, which has 64 sets of 64-byte lines. A length that differs from every multiple of PAGE by at least APART spreads
rows over the sets."""


class Area(Protocol):
    """Pixels that are rendered at once: a tile of the picture, or any other pixels."""

    @property
    def number(self) -> int:
        """Unique in the picture."""

    @property
    def size(self) -> int:
        """Number of pixels."""

    def pixel_numbers(self, picture_width: int) -> Words:
        """(size,) number of each pixel in the picture, row by row."""

    def corners(self) -> tuple[Floats32, Floats32]:
        """Column and row of each pixel's upper left corner, (size,) float32 each [pixels]."""


@dataclass(frozen=True)
class Tile:
    """A rectangle of pixels with its upper left corner at (x, y)."""

    number: int
    x: int
    y: int
    width: int
    height: int

    @property
    def size(self) -> int:
        """Number of pixels."""
        return self.width * self.height

    @property
    def rows(self) -> slice:
        """Rows of the picture."""
        return slice(self.y, self.y + self.height)

    @property
    def columns(self) -> slice:
        """Columns of the picture."""
        return slice(self.x, self.x + self.width)

    def pixel_numbers(self, picture_width: int) -> Words:
        """(size,) number of each pixel in the picture, row by row."""
        x = np.arange(self.x, self.x + self.width, dtype=np.uint32)
        y = np.arange(self.y, self.y + self.height, dtype=np.uint32)
        return (y[:, None] * np.uint32(picture_width) + x).ravel()

    def corners(self) -> tuple[Floats32, Floats32]:
        """Column and row of each pixel's upper left corner, (size,) float32 each [pixels]."""
        x = np.arange(self.x, self.x + self.width, dtype=np.float32)
        y = np.arange(self.y, self.y + self.height, dtype=np.float32)
        return np.tile(x, self.height), np.repeat(y, self.width)


def spread_over_cache(rays: int) -> bool:
    """True if the rows of a (3, rays) array don't all start in the same set of the first-level cache.

    A loop over hits reads thirty rows side by side. With 65536 rays, all rows start in the same set, which holds
    eight lines. The geometry of hits then took twice the time, and a whole render up to 10% more.
    """
    return bool(APART <= rays % PAGE <= PAGE - APART)


def tile_picture(width: int, height: int, samples: int, batches: int = 1) -> list[Tile]:
    """Tiles that cover a picture, the largest first, each of about ``batches`` * RAYS / ``samples`` pixels."""
    tile_width, tile_height = _shape(max(batches * RAYS // samples, 1), samples)
    tiles: list[Tile] = []
    for y in range(0, height, tile_height):
        for x in range(0, width, tile_width):
            size = min(tile_width, width - x), min(tile_height, height - y)
            tiles.append(Tile(len(tiles), x, y, *size))
    # The small tiles at the edges come last.
    tiles.sort(key=lambda tile: -tile.size)
    return tiles


def _shape(pixels: int, samples: int) -> tuple[int, int]:
    """Width and height of a tile of at most ``pixels`` pixels; the sides differ by a factor of 4 at most."""
    widest = 1
    while widest * widest < pixels:
        widest *= 2
    shapes = [(width, pixels // width) for width in range(widest, widest * 3 // 4, -1)]
    fitting = [(w, h) for w, h in shapes if spread_over_cache(w * h * samples)]
    return max(fitting or shapes[:1], key=lambda shape: shape[0] * shape[1])


@dataclass(frozen=True)
class Work:
    """One pass of a tile, or of a piece of a tile.

    Attributes
    ----------
    order : number of the pass; the film adds the passes of a tile in order
    first, samples : first sample and number of samples of each pixel
    summed : true if the pass enters the film's sums
    parts : number of equal groups into which the samples of each pixel are divided; each group has a mean
    pixels : if ``tile`` is a piece of a tile, number of pixels of the whole tile; else None
    """

    tile: Area
    order: int
    first: int
    samples: int
    summed: bool
    parts: int = 1
    pixels: int | None = None


def pass_size(settings: Settings, sampler: Sampler) -> int:
    """Samples per pixel in one pass."""
    return min(settings.samples, PASS) if sampler.extensible else settings.samples


def passes(settings: Settings, sampler: Sampler, done: int = 0, batches: int = 1) -> Iterator[Work]:
    """The work of a render, pass by pass, in tiles of at most ``batches`` batches of rays.

    The film already holds ``done`` samples per pixel, a multiple of PASS.
    """
    size = pass_size(settings, sampler)
    tiles = tile_picture(settings.width, settings.height, size, batches)
    for order, first in enumerate(range(done, settings.samples, size)):
        samples = min(size, settings.samples - first)
        summed = samples == PASS or not sampler.extensible
        for tile in tiles:
            yield Work(tile, order, first, samples, summed)
