"""What Exif data and windows say: how a picture is turned, where its pixels belong, and colours without a profile."""

import struct
from typing import TYPE_CHECKING, Final

import numpy as np

from course.engine.core.types import Floats32

if TYPE_CHECKING:
    from OpenImageIO import ImageSpec
    from PIL.Image import Image

TAG: Final = 0x0112
"""Of the orientation (TIFF 6.0, section 8; Exif 2.32, 4.6.4)."""


EXIF, COLOURS, SRGB = 0x8769, 0xA001, 1
"""Of Exif's own data, its colour space, and the one that has a number of its own (Exif 2.32, 4.6.5)."""

BROKEN: Final = (OSError, ValueError, SyntaxError, KeyError, TypeError, IndexError, struct.error)
"""Errors of Pillow where Exif data is corrupt."""


def in_other_colours(image: "Image") -> bool:
    """Whether Exif data says that colours aren't sRGB's; Adobe RGB has no number of its own."""
    try:
        exif = image.getexif()
        return bool(exif) and exif.get_ifd(EXIF).get(COLOURS, SRGB) != SRGB
    except BROKEN:
        return False


def orientation(image: "Image") -> int:
    """How a picture is turned, from 1, upright, to 8; 1 where it doesn't say so, or not readably."""
    try:
        turned = image.getexif().get(TAG, 1)
    except BROKEN:
        return 1
    return turned if isinstance(turned, int) and 1 <= turned <= 8 else 1


def upright(picture: Floats32, turned: int) -> Floats32:
    """A picture (H, W, 3) of that orientation, the right way up."""
    if turned == 1:
        return picture
    # From 5 on rows are columns: the first row is at the left or the right.
    placed = np.swapaxes(picture, 0, 1) if turned >= 5 else picture
    if turned in (3, 4, 7, 8):
        placed = placed[::-1]
    if turned in (2, 3, 6, 7):
        placed = placed[:, ::-1]
    return np.ascontiguousarray(placed)


def in_display_window(pixels: Floats32, spec: "ImageSpec") -> Floats32:
    """Pixels (h, w, 3) of a data window, in the display window (H, W, 3), black where there are none."""
    if (spec.x, spec.y, spec.width, spec.height) == (
        spec.full_x,
        spec.full_y,
        spec.full_width,
        spec.full_height,
    ):
        return pixels
    left, top = spec.x - spec.full_x, spec.y - spec.full_y
    right, bottom = left + spec.width, top + spec.height
    window = np.zeros((spec.full_height, spec.full_width, 3), np.float32)
    rows = slice(max(top, 0), min(bottom, spec.full_height))
    columns = slice(max(left, 0), min(right, spec.full_width))
    if rows.start >= rows.stop or columns.start >= columns.stop:
        raise ValueError("its data window lies outside of its display window")
    window[rows, columns] = pixels[
        rows.start - top : rows.stop - top, columns.start - left : columns.stop - left
    ]
    return window
