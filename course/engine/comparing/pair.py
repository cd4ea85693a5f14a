"""Two pictures in the form in which they are compared, strip by strip: as 8 bits show them, without what is cut off."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from course.base.errors import CourseError
from course.engine.comparing.noise import Strip, box
from course.engine.comparing.windows import Grid, Window
from course.engine.core.types import Floats32, Floats64, Mask
from course.engine.formats.pictures.display import linear_to_srgb8, srgb_to_linear

FEWEST_PIXELS, NARROWEST = 1024, 16
"""Pixels that a picture needs, and those along its shorter side."""

HALF_STEP = 2.0**-10
"""Distance of two neighbours among OpenEXR's half floats, as a share of their size, at most."""

FLOAT_STEP = 2.0**-14
"""The same for float32, with what a renderer's own sums and constants lose."""

AROUND = 16
"""Rows around a strip that what is found in it hangs on."""

STRIP = 2**16
"""Pixels of a strip, about: its arrays stay in the processor's cache."""

SAMPLE = 16
"""Strips at most that tell of all."""


@dataclass(frozen=True)
class Pair:
    """Two pictures a and b (H, W, 3), linear.

    Attributes
    ----------
    usable : (H, W) pixels that count: neither cut off at white nor beside such
    steps : distance of neighbouring values of a and of b, as a share of their size; None for the codes of 8 bits
    """

    a: Floats32
    b: Floats32
    usable: Mask
    steps: tuple[float | None, float | None]

    @property
    def coded(self) -> bool:
        """Whether both are as 8 bits show them."""
        return self.steps[0] is None

    def part(self, place: Window) -> Strip:
        """What is in a place."""
        usable = self.usable[place.pixels]
        a, b = (one[place.pixels].astype(np.float64) for one in (self.a, self.b))
        return Strip(a, b, (a - b) * usable[..., None], usable)

    def strips(self, grid: Grid) -> Iterator[tuple[Strip, slice, slice]]:
        """Parts of whole rows of cells, and what is around; their own rows among the part's, and the picture's."""
        height, width = self.usable.shape
        cells = max(STRIP // (width * grid.side), 1)
        for first in range(0, len(grid.rows) - 1, cells):
            top, bottom = grid.rows[[first, min(first + cells, len(grid.rows) - 1)]].tolist()
            upper, lower = max(top - AROUND, 0), min(bottom + AROUND, height)
            part = self.part(Window(0, upper, width, lower - upper))
            yield part, slice(top - upper, bottom - upper), slice(top, bottom)

    def sample(self) -> list[Strip]:
        """Strips across the picture that tell what noise is usual, or all of it."""
        height, width = self.usable.shape
        rows = 2 * AROUND
        if height <= SAMPLE * rows:
            return [self.part(Window(0, 0, width, height))]
        tops = np.linspace(0, height - rows, SAMPLE).astype(int).tolist()
        return [self.part(Window(0, top, width, rows)) for top in tops]

    def rounding(self, part: Strip) -> Floats64:
        """By what differences of a part may be off, (H, W, 3)."""
        return rounded(part.a, self.steps[0]) + rounded(part.b, self.steps[1])


def pair_of(a: Floats32, b: Floats32, coded: tuple[bool, bool]) -> Pair:
    """As ``course.engine.comparing.significance.compare`` takes them.

    Raises CourseError: the pictures differ in size, or too little of them is left to compare.
    """
    if a.shape != b.shape:
        raise CourseError(
            f"pictures of {a.shape[1]} x {a.shape[0]} and {b.shape[1]} x {b.shape[0]} pixels can't be compared"
        )
    eight = any(cut and _has_8_bits(one) for one, cut in ((a, coded[0]), (b, coded[1])))
    if eight:
        a, b = _shown(a), _shown(b)
    usable = np.ones(a.shape[:2], bool)
    if any(coded):
        cut: Mask = np.any((a >= 1) | (b >= 1), axis=2)
        usable = ~_spread(cut)
        a, b = np.minimum(a, 1), np.minimum(b, 1)
    _check_size(usable)
    return Pair(a, b, usable, (_step(a, eight), _step(b, eight)))


def _shown(linear: Floats32) -> Floats32:
    """A picture (H, W, 3) as it comes back from a file of 8 bits."""
    return srgb_to_linear(linear_to_srgb8(np.moveaxis(linear, -1, 0)) / 255)


def _has_8_bits(linear: Floats32) -> bool:
    return bool((_shown(linear) == linear).all())


def _spread(mask: Mask) -> Mask:
    """Pixels (H, W) that are in a mask, or have a neighbour that is."""
    padded = np.pad(mask, 1)
    rows = padded[:-2] | padded[1:-1] | padded[2:]
    result: Mask = rows[:, :-2] | rows[:, 1:-1] | rows[:, 2:]
    return result


def _check_size(usable: Mask) -> None:
    height, width = usable.shape
    if min(height, width) >= NARROWEST and usable.sum() >= FEWEST_PIXELS:
        return
    clipped = 1 - float(usable.mean())
    left = f", {clipped:.0%} of them cut off at white or beside such pixels," if clipped else ""
    raise CourseError(
        f"pictures of {width} x {height} pixels{left} leave too little to compare: {FEWEST_PIXELS:,} pixels, and"
        f" {NARROWEST} along each side, are needed; render larger ones"
        + (", or as EXR" if clipped else "")
    )


def _step(linear: Floats32, eight: bool) -> float | None:
    """Distance of neighbouring values as a share of their size; None for the codes of 8 bits."""
    if eight:
        return None
    with np.errstate(all="ignore"):
        half = bool((linear.astype(np.float16) == linear).all())
    return HALF_STEP if half else FLOAT_STEP


def rounded(values: Floats64, step: float | None) -> Floats64:
    """By what the mean of values (H, W, 3) around a pixel may be off because they are rounded.

    Values that spread over several steps are rounded up as often as down. Where all are alike, all are rounded alike,
    by up to half a step. Of values with the variance v [steps^2] the mean is off by less than exp(-2 pi^2 v) / 2 steps:
    that is how the first term of the Fourier series of rounding falls off.
    ``step``: distance of two neighbouring values as a share of their size; None for the codes of 8 bits.
    """
    if step is None:
        # The derivative of the sRGB curve, backwards, over 255.
        curve = 1.055 / 2.4 * np.maximum(values, 1e-6) ** (1 / 2.4 - 1)
        size = 1 / (255 * np.where(values <= 0.0031308, 12.92, curve))
    else:
        size = np.maximum(step * values, 1e-30)
    spread = box(values**2, 5, "mirror") - box(values, 5, "mirror") ** 2
    v = np.maximum(spread, 0) / size**2
    result: Floats64 = size / 2 * np.exp(-2 * np.pi**2 * np.minimum(v, 10))
    return result
