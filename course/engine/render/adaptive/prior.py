"""What is known of a pixel's variance before its samples say it: that of small bright things it may see.

Of n samples each finds a thing of radiance L with chance c. A pixel that has found it is off by about L / n, and its
samples tell so. One that hasn't looks finished, and is off by what it lacks, L c. So until a pixel should have found
it a few times, its squared error is (L c)^2, up to the variance L^2 c / n of the mean, or what its samples tell, if
that is more. This is what is expected given the samples, so it holds whatever has decided on how many there are.
"""

import numpy as np

from course.engine.core.types import Floats32, Floats64, Indices, Mask, Numbers
from course.engine.render.adaptive.glimpses import Chances

SURE = 5.0
"""A thing's finds, as expected, after which what is known would count e times less, and counts for nothing."""

MATTERS = 0.02
"""A pixel has a prior where its variance, by four samples, is more than so much of the mean that is aimed at."""


class Prior:
    """The variance of some pixels by what they may see.

    Parameters
    ----------
    chances : of all pixels
    target : mean variance that the picture shall have
    """

    def __init__(self, chances: Chances, target: float) -> None:
        mean, square = chances.mean.ravel(), chances.square.ravel()
        pixels = np.flatnonzero(square > 4 * MATTERS * target)
        mean, square = mean[pixels], square[pixels]
        self.pixels: Indices = pixels
        """(m,) those that have a prior"""
        self._chance: Floats64 = np.minimum(mean * mean / square, 1)
        self._variance: Floats64 = np.maximum(square - mean * mean, 0)
        self._around = _around(pixels, *chances.mean.shape)

    def in_force(self, samples: Numbers) -> Mask:
        """Which of its pixels (m,) should have found what is known fewer than SURE times."""
        sure: Mask = samples.reshape(-1)[self.pixels] * self._chance < SURE
        return sure

    def believed(self, variance: Floats32, samples: Numbers) -> Floats64:
        """Variances (m,) of its pixels, by theirs (H, W) and by what is known."""
        n, own, others = self._told(variance, samples)
        finds = n * self._chance
        lacks = np.minimum(finds, 1)
        missed = self._variance / n * lacks
        # What those that found nothing lack is no more to be told by the others: the sum is the variance.
        found = own * (1 - np.exp(-finds) * lacks)
        expected = np.maximum(np.where(own > missed / 2, found, missed), others)
        return own + np.exp(-finds / SURE) * (expected - own)

    def others(self, variance: Floats32, samples: Numbers) -> Floats64:
        """The least of the variances next to each of its pixels, (m,), as if with as many samples."""
        return self._told(variance, samples)[2]

    def _told(self, variance: Floats32, samples: Numbers) -> tuple[Floats64, Floats64, Floats64]:
        """Samples (m,), and the variances (m,) that pixels tell: their own, and the least of those next to them."""
        n = samples.reshape(-1)
        unit = variance.reshape(-1).astype(np.float64) * n
        # A render that is interrupted at once has pixels without samples.
        mine = np.maximum(n[self.pixels], 1).astype(np.float64)
        return mine, unit[self.pixels] / mine, unit[self._around].min(axis=0) / mine


def _around(pixels: Indices, height: int, width: int) -> Indices:
    """(5, m) each pixel and the four next to it; those at the edge count for what lies beyond."""
    y, x = np.divmod(pixels, width)
    rows = [y, np.maximum(y - 1, 0), np.minimum(y + 1, height - 1), y, y]
    columns = [x, x, x, np.maximum(x - 1, 0), np.minimum(x + 1, width - 1)]
    result: Indices = np.stack(rows) * width + np.stack(columns)
    return result
