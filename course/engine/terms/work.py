"""Work in other sizes than the tiles of uniform passes: parts of tiles, and quick previews."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from course.engine.core.rays import RAYS
from course.engine.core.samplers import Sampler
from course.engine.core.scene import Settings
from course.engine.core.schedule import Executor, UniformSchedule
from course.engine.core.tiles import (
    PAGE,
    Tile,
    Work,
    pass_size,
    passes,
    spread_over_cache,
    tile_picture,
)

SHARES = 2
"""A piece of work is at most 1 / SHARES of a thread's share of the remaining work."""


def fair_share(remaining: int, threads: int) -> int:
    """Largest piece of work that a thread may take, in the unit of ``remaining``: pixels or rays."""
    return remaining // (SHARES * max(threads, 1))


def halves(tile: Tile) -> tuple[Tile, Tile]:
    """Both halves of a tile of at least two pixels; they keep its number."""
    if tile.width > tile.height:
        half = tile.width // 2
        rest = replace(tile, x=tile.x + half, width=tile.width - half)
        return replace(tile, width=half), rest
    half = tile.height // 2
    rest = replace(tile, y=tile.y + half, height=tile.height - half)
    return replace(tile, height=half), rest


def divided_passes(
    settings: Settings, sampler: Sampler, done: int, batches: int, threads: int
) -> Iterator[Work]:
    """``passes``, whose tiles of several batches are divided when little work remains.

    So no thread waits long for another in the end.
    ``threads``: number of threads that render
    """
    size = pass_size(settings, sampler)
    pixels_of_batch = max(RAYS // size, 1)
    remaining = settings.width * settings.height * len(range(done, settings.samples, size))
    for work in passes(settings, sampler, done, batches):
        pile: list[Any] = [work.tile]
        while pile:
            part = pile.pop()
            if batches > 1 and part.size > max(fair_share(remaining, threads), pixels_of_batch):
                pile += halves(part)[::-1]
                continue
            remaining -= part.size
            yield replace(work, tile=part, pixels=work.tile.size)


class DividedSchedule(UniformSchedule):
    """Uniform passes in one round, with divided tiles."""

    def work(self, executor: Executor) -> Iterator[Work]:
        """See ``UniformSchedule``."""
        tracer = self.tracer
        batches = executor.batches(tracer.batches)
        return divided_passes(tracer.settings, tracer.sampler, self.done, batches, executor.threads)


def preview(settings: Settings, samples: int) -> list[Work]:
    """A quick pass over the whole picture, which later passes replace."""
    return whole_pass(settings, 0, samples, summed=False)


def whole_pass(settings: Settings, first: int, samples: int, *, summed: bool) -> list[Work]:
    """One pass over the whole picture, in tiles of its own; see ``Work``."""
    return [
        Work(tile, 0, first, samples, summed)
        for tile in tile_picture(settings.width, settings.height, samples)
    ]


def spread_pixels(pixels: int, samples: int, more: bool = False) -> int:
    """Nearest number of pixels <= ``pixels`` (>= if ``more``) whose rays spread over the cache; else ``pixels``."""
    numbers = range(pixels, pixels + PAGE) if more else range(pixels, max(pixels - PAGE, 0), -1)
    return next((n for n in numbers if spread_over_cache(n * samples)), pixels)
