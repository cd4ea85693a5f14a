"""The work of a render: tiles are rectangles of pixels that are rendered at once, passes are ranges of their samples.

Every pass but the last has PASS samples. So the film's sums grow in the same steps, and memory stays the same, however
many samples there are in all. A sampler that isn't extensible has one pass.

A batch shares the cost of Python among its rays: the longer NumPy and Embree run per call, the less two threads wait
for each other. Measured on two cores with 1 MB of second-level cache each, whole render / time inside Embree, medians
of five: 1.85 with 32 thousand rays, 1.53 to 1.64 with 64 thousand, 1.59 with 128 thousand.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from course.core.rays import RAYS
from course.core.samplers import Sampler
from course.core.scene import Settings
from course.core.types import Floats32, Words

PASS = 16
"""Samples per pixel in a whole pass of an extensible sampler."""

SHARES = 2
"""A piece of work is at most 1 / SHARES of a thread's share of the remaining work."""

_PAGE, _APART = 1024, 64
"""Both in numbers of four bytes. Addresses that differ by _PAGE share a place in the first-level cache. A good row
length differs from every multiple of _PAGE by at least _APART."""


class Area(Protocol):
    """Pixels that are rendered at once, under a number that is unique in the picture."""

    @property
    def number(self) -> int:
        """Number of the area."""

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
    """True if the rows of a (3, rays) array start at different addresses of the cache.

    A loop over hits reads thirty rows in parallel. With 65536 rays, all rows start at the same place in the cache,
    which holds only eight of them. Finding hits took twice the time, a whole render up to a tenth more.
    """
    return bool(_APART <= rays % _PAGE <= _PAGE - _APART)


def spread_pixels(pixels: int, samples: int, more: bool = False) -> int:
    """Nearest number of pixels <= ``pixels`` (>= if ``more``) whose rays spread over the cache; else ``pixels``."""
    numbers = range(pixels, pixels + _PAGE) if more else range(pixels, max(pixels - _PAGE, 0), -1)
    return next((n for n in numbers if spread_over_cache(n * samples)), pixels)


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
    """Width and height of a tile of at most ``pixels`` pixels, nearly square."""
    widest = 1
    while widest * widest < pixels:
        widest *= 2
    shapes = [(width, pixels // width) for width in range(widest, widest * 3 // 4, -1)]
    fitting = [(w, h) for w, h in shapes if spread_over_cache(w * h * samples)]
    return max(fitting or shapes[:1], key=lambda shape: shape[0] * shape[1])


def halves(tile: Tile) -> tuple[Tile, Tile]:
    """Both halves of a tile of at least two pixels; they keep its number."""
    if tile.width > tile.height:
        half = tile.width // 2
        return (
            replace(tile, width=half),
            replace(tile, x=tile.x + half, width=tile.width - half),
        )
    half = tile.height // 2
    return (
        replace(tile, height=half),
        replace(tile, y=tile.y + half, height=tile.height - half),
    )


@dataclass(frozen=True)
class Work:
    """One tile of one pass, or a piece of that tile.

    Attributes
    ----------
    order : number of the pass; the film adds the passes of a tile in order
    first, samples : first sample and number of samples of each pixel
    summed : true if the pass enters the film's sums
    parts : number of equal parts of each pixel's samples, each with its own mean
    pixels : number of pixels in the whole tile; None if this work is the whole tile
    """

    tile: Area
    order: int
    first: int
    samples: int
    summed: bool
    parts: int = 1
    pixels: int | None = None


def fair_share(remaining: int, threads: int) -> int:
    """Largest piece of work that a thread may take, in the unit of ``remaining``: pixels or rays."""
    return remaining // (SHARES * max(threads, 1))


def pass_size(settings: Settings, sampler: Sampler) -> int:
    """Samples per pixel in one pass."""
    return min(settings.samples, PASS) if sampler.extensible else settings.samples


def passes(
    settings: Settings, sampler: Sampler, done: int = 0, batches: int = 1, threads: int = 1
) -> Iterator[Work]:
    """The work of a render, pass by pass.

    When little work remains, tiles of several batches are split, so that no thread waits long for another.

    Parameters
    ----------
    done : samples per pixel that the film already holds, a multiple of PASS
    batches : most batches of rays in a tile
    threads : number of threads that render
    """
    size = pass_size(settings, sampler)
    tiles = tile_picture(settings.width, settings.height, size, batches)
    one = max(RAYS // size, 1)
    starts = range(done, settings.samples, size)
    remaining = settings.width * settings.height * len(starts)
    for order, first in enumerate(starts):
        samples = min(size, settings.samples - first)
        summed = samples == PASS or not sampler.extensible
        for tile in tiles:
            waiting: list[Tile] = [tile]
            while waiting:
                part = waiting.pop()
                if batches > 1 and part.size > max(fair_share(remaining, threads), one):
                    waiting += halves(part)[::-1]
                    continue
                remaining -= part.size
                yield Work(part, order, first, samples, summed, pixels=tile.size)


def preview(settings: Settings, samples: int) -> list[Work]:
    """A quick pass over the whole picture, which later passes replace."""
    return [
        Work(tile, 0, 0, samples, False)
        for tile in tile_picture(settings.width, settings.height, samples)
    ]


def kept_samples(samples: int) -> int:
    """Samples per pixel that a longer render keeps: those of whole passes."""
    return samples - samples % PASS
