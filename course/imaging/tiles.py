"""Tiles: the rectangles of pixels that are rendered at once.

A batch shares the cost of Python among its rays: two threads wait for each other less the longer NumPy and Embree run
between two calls. Measured on two cores with a second-level cache of 1 MB each, medians of five: whole render over time
inside Embree 1.85 with 32 thousand rays, 1.53 to 1.64 with 64 thousand, 1.59 with 128 thousand. The number of pixels of
a tile follows from the samples of each.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from course.core.types import Floats32, Words

RAYS = 65536
"""Camera rays in a batch, at most."""

_PAGE, _APART = 1024, 64
"""Numbers of four bytes in the stretch of memory after which the places of a first-level cache begin anew, and how far
from a multiple of that the rows of an array should begin."""


class Area(Protocol):
    """Some pixels that are rendered at once, under a number that is different for every area of a picture."""

    @property
    def number(self) -> int:
        """Its number."""
        ...

    @property
    def size(self) -> int:
        """How many pixels."""
        ...

    def pixel_numbers(self, picture_width: int) -> Words:
        """(size,) number of each pixel in the picture, row by row."""
        ...

    def corners(self) -> tuple[Floats32, Floats32]:
        """Column and row of each pixel's upper left corner, (size,) float32 each [pixels]."""
        ...


@dataclass(frozen=True)
class Tile:
    """A rectangle of pixels, its upper left corner at (x, y)."""

    number: int
    x: int
    y: int
    width: int
    height: int

    @property
    def size(self) -> int:
        """How many pixels."""
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
    """Whether the rows of a (3, rays) array lie in different places of the cache.

    A loop over hits goes along thirty rows side by side. At 65536 rays all of them begin at the same place of the
    cache, which has room for eight: finding hits took twice the time, a whole render up to a tenth more.
    """
    return bool(_APART <= rays % _PAGE <= _PAGE - _APART)


def spread_pixels(pixels: int, samples: int, more: bool = False) -> int:
    """The nearest number of pixels, none more or none fewer, whose rays spread over the cache; else ``pixels``."""
    numbers = range(pixels, pixels + _PAGE) if more else range(pixels, max(pixels - _PAGE, 0), -1)
    return next((n for n in numbers if spread_over_cache(n * samples)), pixels)


def tile_picture(width: int, height: int, samples: int, batches: int = 1) -> list[Tile]:
    """Tiles that cover a picture, each with about so many batches of RAYS rays at that many samples a pixel."""
    tile_width, tile_height = _shape(max(batches * RAYS // samples, 1), samples)
    tiles: list[Tile] = []
    for y in range(0, height, tile_height):
        for x in range(0, width, tile_width):
            size = min(tile_width, width - x), min(tile_height, height - y)
            tiles.append(Tile(len(tiles), x, y, *size))
    # The small ones at the edges last.
    tiles.sort(key=lambda tile: -tile.size)
    return tiles


def _shape(pixels: int, samples: int) -> tuple[int, int]:
    """Width and height of a tile of at most so many pixels, about as high as wide."""
    widest = 1
    while widest * widest < pixels:
        widest *= 2
    shapes = [(width, pixels // width) for width in range(widest, widest * 3 // 4, -1)]
    fitting = [(w, h) for w, h in shapes if spread_over_cache(w * h * samples)]
    return max(fitting or shapes[:1], key=lambda shape: shape[0] * shape[1])


def halves(tile: Tile) -> tuple[Tile, Tile]:
    """Both halves of a tile of more than one pixel, under its number."""
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
