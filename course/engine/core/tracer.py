"""The steps of one tile: random numbers, camera rays, radiance, pixels."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from course.engine.core.counters import Counters
from course.engine.core.film import Reconstruction
from course.engine.core.integrator import Integrator
from course.engine.core.rays import RAYS, Dimensions, Draws
from course.engine.core.samplers import Block, Sampler
from course.engine.core.scene import Settings
from course.engine.core.tiles import Area
from course.engine.core.types import Floats32


@dataclass(frozen=True)
class Tracer:
    """Renders tiles of up to ``batches`` batches of camera rays. All threads share it.

    ``costs(n)`` creates the costs of n new paths (``course.engine.render.adaptive.costs``); None without adaptive
    sampling.
    """

    settings: Settings
    sampler: Sampler
    dimensions: Dimensions
    integrator: Integrator
    reconstruction: Reconstruction
    batches: int = 1
    costs: Callable[[int], Any] | None = None
    smallest: int = RAYS

    def render_tile(
        self,
        tile: Area,
        first: int,
        samples: int,
        counters: Counters,
        cancelled: Callable[[], bool] = lambda: False,
        parts: int = 1,
    ) -> tuple[Floats32, Floats32 | float]:
        """Colours (3, n * parts) and weights of a tile's n pixels; with adaptive sampling a fourth row has the costs.

        Each pixel gets ``samples`` samples from number ``first`` on. They are divided into ``parts`` equal groups,
        whose means are adjacent columns of the result. Raises CancelledError soon after ``cancelled()`` becomes true.
        """
        counters.start()
        block = Block(tile.pixel_numbers(self.settings.width), first, samples, tile.number)
        costs = self.costs(block.size) if self.costs is not None and parts > 1 else None
        draws = Draws(self.sampler, self.dimensions, block, counters, cancelled, costs)
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
        if costs is not None:
            mean = costs.with_row(mean, parts)
        return mean, weight
