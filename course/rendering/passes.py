"""Passes: the picture's samples in stretches, each over all tiles.

Every stretch but the last has PASS samples, so the film's sums grow in the same steps whatever the total, and memory
doesn't depend on it. Samplers that can't be extended place all their samples at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from course.core.samplers import Sampler
from course.imaging.tiles import RAYS, Area, Tile, halves, tile_picture

PASS = 16
"""Samples of each pixel in a whole pass of an extensible sampler."""

SHARES = 2
"""What is rendered at once is at most one part in so many of what each thread would get of what is left to do."""


class Sampling(Protocol):
    """Size of a picture [pixels], and how many samples each pixel gets."""

    @property
    def width(self) -> int:
        """Pixels in a row."""

    @property
    def height(self) -> int:
        """Pixels in a column."""

    @property
    def samples(self) -> int:
        """Samples of a pixel."""


@dataclass(frozen=True)
class Work:
    """One tile of one pass, or a part of it.

    Attributes
    ----------
    order : number of the pass, for the film adds the passes of a tile in order
    whole : whether the film keeps its sums
    parts : into which the samples of a pixel are divided, each a mean of its own
    pixels : of the whole tile; None where this is all of it
    """

    tile: Area
    order: int
    first: int
    samples: int
    whole: bool
    parts: int = 1
    pixels: int | None = None


def fair_share(left: int, threads: int) -> int:
    """What may be rendered at once where so much is left to do."""
    return left // (SHARES * max(threads, 1))


def pass_size(settings: Sampling, sampler: Sampler) -> int:
    """Samples of each pixel in one pass."""
    return min(settings.samples, PASS) if sampler.extensible else settings.samples


def passes(
    settings: Sampling, sampler: Sampler, done: int = 0, batches: int = 1, threads: int = 1
) -> Iterator[Work]:
    """The work of a render, pass by pass.

    Tiles of several batches come in parts where little is left to do, so that no thread waits long for another.

    Parameters
    ----------
    done : samples that a film already holds, a multiple of PASS
    batches : of rays that a tile may have
    threads : that render
    """
    size = pass_size(settings, sampler)
    tiles = tile_picture(settings.width, settings.height, size, batches)
    one = max(RAYS // size, 1)
    starts = range(done, settings.samples, size)
    left = settings.width * settings.height * len(starts)
    for order, first in enumerate(starts):
        samples = min(size, settings.samples - first)
        whole = samples == PASS or not sampler.extensible
        for tile in tiles:
            waiting: list[Tile] = [tile]
            while waiting:
                part = waiting.pop()
                if batches > 1 and part.size > max(fair_share(left, threads), one):
                    waiting += halves(part)[::-1]
                    continue
                left -= part.size
                yield Work(part, order, first, samples, whole, pixels=tile.size)


def preview(settings: Sampling, samples: int) -> list[Work]:
    """A quick pass that later ones replace, so that a picture is whole before it is good."""
    return [
        Work(tile, 0, 0, samples, False)
        for tile in tile_picture(settings.width, settings.height, samples)
    ]


def kept_samples(samples: int) -> int:
    """How many of a film's samples a longer render may keep: those of whole passes."""
    return samples - samples % PASS
