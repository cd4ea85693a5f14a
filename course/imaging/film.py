"""The film: weighted sums of what all samples of a pixel have brought so far.

Samples arrive in passes. Sums of whole passes are kept in float64 and always grow in the same order; a last pass that
is not whole goes into the picture but not into the sums. So a picture continued from n to 2n samples repeats the
part-pass and is the same, bit for bit, as one that was rendered in one go.
"""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from course.core.types import Floats32, Numbers
from course.imaging.tiles import Tile

_NEARLY_NOTHING = 1e-300
"""Weight of a mean whose own weights vanish: enough to be divided by, too little to count beside any other."""


class AnyFilm(Protocol):
    """A picture in the making: takes in rendered pieces; which ones, and how, is for the kinds of films.

    Attributes
    ----------
    linear : (3, H, W) linear radiance, row 0 the top row
    samples : (H, W) samples behind each pixel
    """

    linear: Floats32
    samples: Numbers

    def add(
        self, tile: Any, mean: Floats32, weight: Floats32 | float, samples: int, whole: bool
    ) -> None:
        """Take in one piece; see ``Film.add``."""
        ...


class Film:
    """The film of uniform sampling.

    Parameters
    ----------
    width, height : pixels
    """

    def __init__(self, width: int, height: int) -> None:
        self.width = width
        self.height = height
        self.linear = np.zeros((3, height, width), np.float32)
        """(3, H, W) linear radiance, valid where a pass has been added."""
        self.samples = np.zeros((height, width), np.int32)
        """(H, W) samples behind each pixel of ``linear``."""
        self._sum = np.zeros((3, height, width))
        self._weight = np.zeros((height, width))

    def add(
        self, tile: Tile, mean: Floats32, weight: Floats32 | float, samples: int, whole: bool
    ) -> None:
        """Add one pass of a tile.

        Parameters
        ----------
        mean : (3, n) float32, for the tile's n pixels row by row
        weight : (n,) float32 or one number
        samples : how many samples of each pixel the picture holds with this pass
        whole : whether the pass enters the sums; a part-pass only enters the picture, and is the last
        """
        rows, columns = tile.rows, tile.columns
        shape = (tile.height, tile.width)
        w = np.broadcast_to(np.asarray(weight, np.float64).reshape(-1), (tile.size,)).reshape(shape)
        w = np.maximum(w, _NEARLY_NOTHING)
        total = self._sum[:, rows, columns] + mean.reshape(3, *shape) * w
        total_weight = self._weight[rows, columns] + w
        if whole:
            self._sum[:, rows, columns] = total
            self._weight[rows, columns] = total_weight
        self.linear[:, rows, columns] = total / total_weight
        self.samples[rows, columns] = samples

    def continued(self, samples: int) -> Film:
        """A copy as the start of a longer render, holding the sums of the first ``samples`` samples."""
        film = Film(self.width, self.height)
        film._sum[:] = self._sum
        film._weight[:] = self._weight
        film.linear[:] = self.linear
        film.samples[:] = samples
        return film
