"""Pixels from anywhere in the picture that are rendered at once, for renders that don't treat all pixels alike."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from course.engine.core.types import Floats32, Indices, Words

_BLOCK = 32


@dataclass(frozen=True)
class PixelGroup:
    """Some pixels of a picture.

    Attributes
    ----------
    number : different for every group of a render
    pixels : (n,) intp, their numbers in the picture, row by row
    width : of the picture
    """

    number: int
    pixels: Indices
    width: int

    @property
    def size(self) -> int:
        """Number of pixels."""
        return len(self.pixels)

    def pixel_numbers(self, picture_width: int) -> Words:
        """(size,) number of each pixel in the picture."""
        return self.pixels.astype(np.uint32)

    def corners(self) -> tuple[Floats32, Floats32]:
        """Column and row of each pixel's upper left corner, (size,) float32 each [pixels]."""
        y, x = np.divmod(self.pixels, self.width)
        return x.astype(np.float32), y.astype(np.float32)


@dataclass(frozen=True)
class TwinGroup(PixelGroup):
    """Pixels that are rendered a second time, by other points: samplers take them for pixels of another picture.

    Attributes
    ----------
    shift : added to the numbers that samplers see; a multiple of the picture's pixels, different for every time
    """

    shift: int

    def pixel_numbers(self, picture_width: int) -> Words:
        """(size,) number of each pixel, as if the pictures lay one below the other."""
        return (self.pixels + self.shift).astype(np.uint32)


def nearby_order(width: int, height: int) -> Indices:
    """Numbers of all pixels in blocks of 32 x 32, row by row of blocks and along Morton's curve within each.

    Neighbours in a stretch of this order are neighbours in the picture: rays through them meet the same triangles and
    finish sooner.
    """
    within_y, within_x = np.divmod(np.arange(_BLOCK * _BLOCK, dtype=np.uint64), np.uint64(_BLOCK))
    along = np.argsort(_spread(within_x) | _spread(within_y) << np.uint64(1))
    y = np.arange(0, height, _BLOCK)[:, None, None] + within_y.take(along).astype(np.intp)
    x = np.arange(0, width, _BLOCK)[:, None] + within_x.take(along).astype(np.intp)
    return (y * width + x)[(y < height) & (x < width)]


def _spread(x: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """The lower 16 bits of x at every second place."""
    for shift, mask in ((8, 0x00FF00FF), (4, 0x0F0F0F0F), (2, 0x33333333), (1, 0x55555555)):
        x = (x | x << np.uint64(shift)) & np.uint64(mask)
    return x
