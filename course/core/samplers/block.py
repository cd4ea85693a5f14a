"""A block of paths: some pixels, the same stretch of samples in each, in the order pixel by pixel.

Path number p of a block belongs to pixel p // samples and is its sample first + p % samples. All samplers number
paths like that, so that a batch of rays and its film pixels line up by reshaping.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from course.core.types import Indices, Words


@dataclass(frozen=True)
class Block:
    """Which paths a batch holds.

    Attributes
    ----------
    pixels : (n,) uint32
        Number of each pixel in the whole picture, row by row.
    first : int
        Number of the first sample of this stretch, the same in every pixel.
    samples : int
        How many samples of each pixel.
    part : int
        A number that is different for every block of a picture, for samplers that draw at random.
    """

    pixels: Words
    first: int
    samples: int
    part: int

    @cached_property
    def size(self) -> int:
        """How many paths: pixels times samples."""
        return len(self.pixels) * self.samples

    def places(self, path: Indices) -> tuple[Indices, Indices]:
        """Column of ``pixels`` and number in the stretch of some paths, (n,) each."""
        bits = self.samples.bit_length() - 1
        if self.samples == 1 << bits:
            return path >> bits, path & (self.samples - 1)
        pixel, sample = np.divmod(path, self.samples)
        return pixel, sample
