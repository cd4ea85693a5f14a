"""Radiance on a screen: the sRGB curve of IEC 61966-2-1, white, and heat maps of one number a pixel."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats, Floats32

BLOCK_VALUES = 1 << 18
"""Values encoded at a time: what the curve needs besides its result stays near 3 MB."""


def linear_to_srgb8(linear: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Encode a linear picture for a screen.

    ``linear``: (3, H, W) float32, linear RGB, 0 black and 1 white. Values above 1 show as 1, values below 0 as 0.
    Returns (H, W, 3) uint8: the nearest sRGB code of each value.

    IEC 61966-2-1: 12.92 x up to 0.0031308, 1.055 x^(1/2.4) - 0.055 from there on.
    """
    _, height, width = linear.shape
    codes = np.empty((height, width, 3), np.uint8)
    rows = max(1, BLOCK_VALUES // max(1, 3 * width))
    for first in range(0, height, rows):
        block = slice(first, first + rows)
        codes[block] = np.moveaxis(_encode(linear[:, block]), 0, -1)
    return codes


def srgb_to_linear(encoded: Floats) -> Floats32:
    """Linear values of encoded ones, both from 0 to 1 and of any shape.

    IEC 61966-2-1, backwards: x / 12.92 up to 0.04045, ((x + 0.055) / 1.055)^2.4 from there on.
    """
    x = np.asarray(encoded)
    linear = np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)
    return linear.astype(np.float32)


def _encode(linear: NDArray[np.float32]) -> NDArray[np.uint8]:
    codes: NDArray[np.uint8] = (255.0 * _curve(linear) + 0.5).astype(np.uint8)
    return codes


def _curve(linear: Floats) -> Floats:
    x = np.clip(linear, 0.0, 1.0, dtype=np.float32)
    curve = 1.055 * np.power(x, np.float32(1 / 2.4)) - 0.055
    return np.asarray(np.where(x <= 0.0031308, 12.92 * x, curve))


ROUNDING = 2.0**-17
"""A value this close below a code, as a share of it, is meant to be that code: float32 sums of many samples.

For means of 1 to 900 equal samples the share is at most 2^-18.2; see tests/engine/formats/metu/test_eight_bits.py.
"""


BRIGHTEST = np.float32(1e19)
"""Of what is shown, where white is 1: 60 stops more of it are a float32 still, and 60 stops less are white still."""


@dataclass(frozen=True)
class Display:
    """The mapping of radiance to codes of 8 bits.

    Attributes
    ----------
    white : the radiance that shows as 255
    encoding : "srgb", the nearest code of the curve; or "linear", in proportion to the radiance and rounded down
    develop : makes the codes in another way, by the functions of the module `film`; None for the two above
    """

    white: float = 1.0
    encoding: str = "srgb"
    develop: Callable[[Floats32], NDArray[np.uint8]] | None = None

    def codes(self, linear: NDArray[np.float32]) -> NDArray[np.uint8]:
        """(H, W, 3) uint8 codes of a picture (3, H, W) float32; beyond white they stay 255, below 0 they are 0."""
        if self.develop is not None:
            return self.develop(linear)
        if self.encoding == "linear":
            scaled = linear.astype(np.float64) * (255.0 / self.white * (1.0 + ROUNDING))
            return np.ascontiguousarray(
                np.moveaxis(np.clip(scaled, 0, 255).astype(np.uint8), 0, -1)
            )
        return linear_to_srgb8(over_white(linear, self.white))


def over_white(radiance: Floats32, white: float) -> Floats32:
    """Radiance of any shape, float32, over what is shown as white: at most ``BRIGHTEST``, from either side of 0."""
    if white == 1:
        return radiance
    # In float64: light of 1e30 over the least white that a scene may ask for is no float32.
    shown: Floats32 = np.clip(radiance / np.float64(white), -BRIGHTEST, BRIGHTEST).astype(
        np.float32
    )
    return shown


SRGB = Display()
"""The mapping that screens expect."""


# sRGB; of steadily growing lightness, so that the order of the values survives a grey printer.
_COLOURS = np.frombuffer(
    bytes.fromhex("000000 300854 80146c c9323e f27612 fbc528 ffffe6"), np.uint8
).reshape(-1, 3)


def heat_map(values: Floats) -> Floats32:
    """Colours (3, H, W) float32, linear RGB, of positive numbers (H, W) on a logarithmic scale.

    The smallest number is black and the largest white; where all are the same, everything is black.
    """
    logarithm = np.log(np.asarray(values, np.float64))
    low, high = logarithm.min(), logarithm.max()
    place = (logarithm - low) / (high - low if high > low else 1.0) * (len(_COLOURS) - 1)
    srgb = [np.interp(place, np.arange(len(_COLOURS)), channel / 255) for channel in _COLOURS.T]
    return srgb_to_linear(np.stack(srgb))
