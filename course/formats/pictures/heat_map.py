"""Heat maps: one number a pixel, shown as colours from black through red and yellow to white."""

from __future__ import annotations

import numpy as np

from course.core.types import Floats, Floats32
from course.formats.pictures.srgb import srgb_to_linear

# sRGB; of steadily growing lightness, so that the order of the values survives a grey printer.
_COLOURS = np.array(
    [
        (0, 0, 0),
        (48, 8, 84),
        (128, 20, 108),
        (201, 50, 62),
        (242, 118, 18),
        (251, 197, 40),
        (255, 255, 230),
    ]
)


def heat_map(values: Floats) -> Floats32:
    """Colours (3, H, W) float32, linear RGB, of positive numbers (H, W) on a logarithmic scale.

    The smallest number is black and the largest white; where all are the same, everything is black.
    """
    logarithm = np.log(np.asarray(values, np.float64))
    low, high = logarithm.min(), logarithm.max()
    place = (logarithm - low) / (high - low if high > low else 1.0) * (len(_COLOURS) - 1)
    srgb = [np.interp(place, np.arange(len(_COLOURS)), channel / 255) for channel in _COLOURS.T]
    return srgb_to_linear(np.stack(srgb))
