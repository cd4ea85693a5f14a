"""The sRGB curve of IEC 61966-2-1, from linear radiance to codes of 8 bits and back."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from course.core.types import Floats, Floats32

BLOCK_VALUES = 1 << 18
"""Values encoded at a time: what the curve needs besides its result stays near 3 MB."""


def linear_to_srgb8(linear: NDArray[np.float32]) -> NDArray[np.uint8]:
    """Encode a linear picture for a screen.

    Parameters
    ----------
    linear : (3, H, W) float32
        Linear RGB, 0 black and 1 white. Values above 1 show as 1, values below 0 as 0.

    Returns
    -------
    (H, W, 3) uint8
        The nearest sRGB code of each value.

    Notes
    -----
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

    Notes
    -----
    IEC 61966-2-1, backwards: x / 12.92 up to 0.04045, ((x + 0.055) / 1.055)^2.4 from there on.
    """
    x = np.asarray(encoded)
    linear = np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)
    return linear.astype(np.float32)


def _encode(linear: NDArray[np.float32]) -> NDArray[np.uint8]:
    x = np.clip(linear, 0.0, 1.0, dtype=np.float32)
    curve = 1.055 * np.power(x, np.float32(1 / 2.4)) - 0.055
    encoded = np.where(x <= 0.0031308, 12.92 * x, curve)
    codes: NDArray[np.uint8] = (255.0 * encoded + 0.5).astype(np.uint8)
    return codes
