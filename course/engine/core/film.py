"""From samples to pixels: the filter of the module ``supersampling``, and the film with its weighted sums of radiance.

Samples arrive in passes. The sums are float64, and are accumulated in a fixed order. If the last pass is
partial, it is added to the picture, but not to the sums. A continued render repeats that pass in full, so its picture
has the same bits as one that was rendered in one go.
"""

from copy import deepcopy
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from course.engine.core.tiles import Tile
from course.engine.core.types import Floats32, Functions, Numbers

_NEARLY_NOTHING = 1e-300
"""Minimum sum of weights, so that no mean divides by 0."""


@dataclass(frozen=True)
class Reconstruction:
    """A filter no wider than the pixel.

    Attributes
    ----------
    single : true if each pixel has one sample, whose radiance is the pixel's colour
    sigma : standard deviation of the Gaussian [pixels]; None for the box filter
    """

    supersampling: Functions
    single: bool
    sigma: float | None

    def pixels(self, radiance: Floats32, offsets: Floats32) -> tuple[Floats32, Floats32 | float]:
        """Weighted means over the samples of n pixels, (3, n) float32, and the sums of their weights, (n,) float32 or
        one number.

        Parameters
        ----------
        radiance : (3, n, s) float32 of s samples in each pixel
        offsets : (2, n, s) float32 [pixels], positions of the samples in their pixels
        """
        n, s = radiance.shape[1:]
        weights: Floats32 = np.ones((n, s), np.float32)
        total: Floats32 | float = float(s)
        if self.sigma is not None:
            weights = self.supersampling.gaussian_weights(offsets, self.sigma)
            total = weights.sum(axis=1)
        if self.single:
            return radiance[:, :, 0], total
        return self.supersampling.resolve(radiance, weights), total


class AnyFilm(Protocol):
    """The interface of a film; see ``Film``."""

    linear: Floats32
    samples: Numbers

    def add(
        self, tile: Any, mean: Floats32, weight: Floats32 | float, samples: int, summed: bool
    ) -> None:
        """Add one piece; see ``Film.add``."""


class Film:
    """The film of uniform sampling; ``width`` and ``height`` in pixels."""

    def __init__(self, width: int, height: int) -> None:
        self.width = width
        self.height = height
        self.linear = np.zeros((3, height, width), np.float32)
        """(3, H, W) linear radiance, row 0 at the top, valid where a pass was added."""
        self.samples = np.zeros((height, width), np.int32)
        """(H, W) samples of each pixel of ``linear``."""
        self._sum = np.zeros((3, height, width))
        self._weight = np.zeros((height, width))

    def add(
        self, tile: Tile, mean: Floats32, weight: Floats32 | float, samples: int, summed: bool
    ) -> None:
        """Add one pass of a tile.

        Parameters
        ----------
        mean : (3, n) float32, radiance of the tile's n pixels, row by row
        weight : (n,) float32 or one number
        samples : samples per pixel so far, including this pass
        summed : true if the pass is added to the sums
        """
        rows, columns = tile.rows, tile.columns
        shape = (tile.height, tile.width)
        w = np.broadcast_to(np.asarray(weight, np.float64).reshape(-1), (tile.size,)).reshape(shape)
        w = np.maximum(w, _NEARLY_NOTHING)
        total = self._sum[:, rows, columns] + mean.reshape(3, *shape) * w
        total_weight = self._weight[rows, columns] + w
        if summed:
            self._sum[:, rows, columns] = total
            self._weight[rows, columns] = total_weight
        self.linear[:, rows, columns] = total / total_weight
        self.samples[rows, columns] = samples

    def continued(self, samples: int) -> "Film":
        """A copy that a longer render continues. Its sums hold the first ``samples`` samples of each pixel."""
        film = deepcopy(self)
        film.samples[:] = samples
        return film
