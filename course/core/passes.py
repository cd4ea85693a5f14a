"""Passes: ranges of a pixel's samples, each rendered over all tiles.

Every pass but the last has PASS samples. So the film's sums grow in the same steps, and memory stays the same, however
many samples there are in all. A sampler that isn't extensible has one pass.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from course.core.samplers import Sampler
from course.core.scene import Settings
from course.core.tiles import RAYS, Area, Tile, halves, tile_picture

PASS = 16
"""Samples per pixel in a whole pass of an extensible sampler."""

SHARES = 2
"""A piece of work is at most 1 / SHARES of a thread's share of the remaining work."""


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
