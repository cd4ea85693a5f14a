"""Exposure: which radiance a picture file shows as white, and by which curve."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.formats.pictures.srgb import linear_to_srgb8

ROUNDING = 2.0**-17
"""A value this close below a code, as a share of it, is meant to be that code: float32 sums of many samples.

For means of 1 to 900 equal samples the share is at most 2^-18.2; see tests/scene/metu/test_eight_bits.py.
"""


@dataclass(frozen=True)
class Display:
    """How radiance becomes codes of 8 bits.

    Attributes
    ----------
    white : the radiance that shows as 255
    encoding : "srgb", the nearest code of the curve; or "linear", in proportion to the radiance and rounded down
    """

    white: float = 1.0
    encoding: str = "srgb"

    def codes(self, linear: NDArray[np.float32]) -> NDArray[np.uint8]:
        """(H, W, 3) uint8 codes of a picture (3, H, W) float32; beyond white they stay 255, below 0 they are 0."""
        if self.encoding == "linear":
            scaled = linear.astype(np.float64) * (255.0 / self.white * (1.0 + ROUNDING))
            return np.ascontiguousarray(
                np.moveaxis(np.clip(scaled, 0, 255).astype(np.uint8), 0, -1)
            )
        if self.white != 1:
            linear = (linear / self.white).astype(np.float32)
        return linear_to_srgb8(linear)


SRGB = Display()
"""What screens expect."""
