"""Values that light can't have, of a picture that is right but for them: made such as it can have, and told."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import numpy as np

from course.base.errors import SceneError
from course.base.inputs import InputLimit, shown
from course.engine.core.types import Floats32

HALF: Final = 65504.0
"""The largest number of 16 bits: what is beyond it in a file of such numbers is infinite there."""

_HUGE: Final = float(np.finfo(np.float32).max)

STRIP: Final = 1 << 20
"""Pixels that are converted at a time: steps in between take memory for these only, and not for the picture."""


@dataclass(frozen=True)
class ReadPicture:
    """A picture as it has been read.

    Attributes
    ----------
    pixels : (H, W, 3)
    notes : what is to be told of it
    white : what its colours can't exceed; infinite where they are light
    """

    pixels: Floats32
    notes: list[str] = field(default_factory=list)
    white: float = np.inf


def check_size(width: int, height: int, pixels: InputLimit) -> None:
    """Raise ValueError for a picture of more pixels than are allowed, before they are read."""
    if width * height > pixels.most:
        raise ValueError(f"{width} x {height} are more than {pixels.most:,} pixels{pixels.remedy}")


def mend(found: ReadPicture, path: Path) -> list[str]:
    """Make values those that light can have, and say of how many pixels; SceneError where some are no numbers."""
    infinite = negative = bright = 0
    lowest: tuple[float, int, int] = 0.0, 0, 0
    picture = found.pixels
    width = picture.shape[1]
    for rows in strips(*picture.shape[:2]):
        part = picture[rows]
        if part.min(initial=0) >= 0 and part.max(initial=0) <= min(found.white, _HUGE):
            continue
        nothing = np.argwhere(np.isnan(part) | (part == -np.inf))
        if len(nothing):
            y, x = nothing[0][:2]
            raise SceneError(
                f"{shown(path)}: the pixel in column {x}, row {y + rows.start} is not a number, or less than any:"
                " mend it where the picture was made"
            )
        low = part.min(axis=2)
        negative += int(np.count_nonzero(low < 0))
        if low.min() < lowest[0]:
            y, x = divmod(int(low.argmin()), width)
            lowest = float(low.min()), x, y + rows.start
        infinite += int(np.isinf(part).any(axis=2).sum())
        bright += int(((part > found.white) & ~np.isinf(part)).any(axis=2).sum())
    notes = []
    if infinite:
        largest = max(
            (float(np.where(np.isinf(part), 0, part).max()) for part in parts_of(picture)),
            default=0,
        )
        largest = max(largest, HALF)
        notes.append(f"pixels that are infinite: {infinite:,}, taken for {largest:g}")
        for part in parts_of(picture):
            part[np.isinf(part)] = largest
    if negative:
        value, x, y = lowest
        notes.append(
            f"pixels that are negative: {negative:,}, down to {value:.3g} in column {x}, row {y}, taken for 0"
        )
    if bright:
        notes.append(f"pixels of colours that sRGB hasn't: {bright:,}, taken for its nearest")
    if negative or bright:
        for part in parts_of(picture):
            np.clip(part, 0, found.white, out=part)
    return notes


def parts_of(picture: Floats32) -> Iterator[Floats32]:
    """Views of a picture (H, W, 3), a strip after the other."""
    return (picture[rows] for rows in strips(*picture.shape[:2]))


def strips(height: int, width: int) -> Iterator[slice]:
    """Rows of a picture, a strip after the other."""
    step = max(1, STRIP // width)
    return (slice(y, min(y + step, height)) for y in range(0, height, step))
