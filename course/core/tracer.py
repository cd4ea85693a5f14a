"""The steps of one tile: random numbers, camera rays, radiance, pixels."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course.core.counters import Counters
from course.core.integrator import Integrator
from course.core.rays import Dimensions, Draws
from course.core.reconstruction import Reconstruction
from course.core.samplers import Block, Sampler
from course.core.scene import Settings
from course.core.tiles import Area
from course.core.types import Floats32


def never() -> bool:
    """False: the default of ``cancelled``."""
    return False


@dataclass(frozen=True)
class Tracer:
    """Renders tiles of ``batches`` times RAYS camera rays, fewer in small pictures. All threads share it."""

    settings: Settings
    sampler: Sampler
    dimensions: Dimensions
    integrator: Integrator
    reconstruction: Reconstruction
    batches: int = 1

    def render_tile(
        self,
        tile: Area,
        first: int,
        samples: int,
        counters: Counters,
        cancelled: Callable[[], bool] = never,
        parts: int = 1,
    ) -> tuple[Floats32, Floats32 | float]:
        """Colours (3, n * parts) and weights of a tile's n pixels.

        Parameters
        ----------
        first, samples : number of each pixel's first sample, and how many samples
        parts : number of equal parts of the samples, each with its own mean; a pixel's parts are adjacent columns

        Raises
        ------
        CancelledError
            Soon after ``cancelled()`` becomes true.
        """
        counters.start()
        block = Block(tile.pixel_numbers(self.settings.width), first, samples, tile.number)
        draws = self.draws(block, counters, cancelled)
        offsets = draws("pixel").reshape(2, tile.size, samples)
        counters.lap("sampler")
        x, y = tile.corners()
        x, y = (x[:, None] + offsets[0]).ravel(), (y[:, None] + offsets[1]).ravel()
        rays = self.integrator.camera_rays(x, y, draws)
        counters.rays["camera"] += rays.size
        counters.lap("camera")
        radiance = self.integrator.radiance(rays, draws)
        pieces = (-1, tile.size * parts, samples // parts)
        mean, weight = self.reconstruction.pixels(radiance.reshape(pieces), offsets.reshape(pieces))
        counters.lap("film")
        return mean, weight

    def draws(self, block: Block, counters: Counters, cancelled: Callable[[], bool]) -> Draws:
        """Random numbers for the paths of a block."""
        return Draws(self.sampler, self.dimensions, block, counters, cancelled)
