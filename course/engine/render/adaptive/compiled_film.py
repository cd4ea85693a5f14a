"""An adaptive film whose arithmetic is compiled: the same bits in less than half the time; imports Numba."""

import numpy as np

from course.engine.core.types import Floats32, Indices
from course.engine.render.adaptive import film_kernels
from course.engine.render.adaptive.film import PARTS, AdaptiveFilm, shares_of
from course.engine.render.adaptive.pixel_groups import PixelGroup


class CompiledFilm(AdaptiveFilm):
    """See ``AdaptiveFilm``."""

    @classmethod
    def tried(cls) -> None:
        """Use each loop once: they are compiled, or read from disk, when they are first called."""
        film, group = cls(1, 1), PixelGroup(0, np.zeros(1, np.intp), 1)
        for samples in (PARTS, 2 * PARTS):
            film.add(group, np.ones((4, PARTS), np.float32), 1.0, samples, True)
        film.end_round()

    def _add_stretch(
        self, which: Indices, mean: Floats32, weight: Floats32 | float, samples: int
    ) -> None:
        have = self.samples.reshape(-1)
        before = int(have[which[0]])
        film_kernels.add_stretch(
            *(which, mean, np.atleast_1d(np.asarray(weight, np.float32)), np.int32(samples)),
            *(shares_of(before, samples, self.order), np.float32((samples - before) / samples)),
            (
                *(self._sums, self._halves, self._quarters, self.linear.reshape(3, -1)),
                *(self.variance.reshape(-1), self.cost.reshape(-1), have),
            ),
        )

    def _smoothed(self, order: float, variance: Floats32) -> tuple[Floats32, Floats32]:
        shape = variance.shape
        weights, (total, own) = np.empty((4, *shape), np.float32), np.empty((2, *shape), np.float32)
        mixed, cost = np.empty((2, *shape), np.float32)
        film_kernels.likeness(self.linear, variance, total, weights)
        np.exp(weights, out=weights)
        film_kernels.weigh(weights, total)
        scale = self.samples.astype(np.float32) ** np.float32(2 * order)
        film_kernels.smooth(variance, scale, self.samples, weights, total, own, mixed)
        scale[:] = 1
        film_kernels.smooth(self.cost, scale, self.samples, weights, total, own, cost)
        return mixed, cost
