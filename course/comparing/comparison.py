"""Are two pictures the same but for noise? A Student test in blocks of pixels, and one of all blocks together.

How noisy a pixel is nobody says, and its neighbour may be a hundred times as noisy. So the picture is divided into
blocks of 4 x 4 cells, and the difference of the pictures in a block is measured by how much its cells differ from each
other. One t a block sees what is wrong in a place; all of them together see what is wrong everywhere, a change of
brightness say, long before one block alone could.

    d      signed difference of a cell, a mean over its pixels; one for each channel
    t      mean of d over the block's cells / its standard error
    T      sum of t / root of the sum of t^2: self-normalized, so it needs neither the variance of t nor its law
           (Shao and Wang, "Self-normalized limit theorems: a survey", 2013)

If both pictures have the same noise, d is as often positive as negative, whatever its tails; a t is then too large
less often than Student's law says (Efron, "Student's t-test under symmetry conditions", 1969).

A place that is smaller than a block's cells, or lies across the borders of some, can't be told from noise so. A third
test looks for one spot of three pixels or more (``course.comparing.spots``). How many pixels differ at all, and which
one most, is told beside it.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.comparing.blocks import SMALLEST, differences, divide, together
from course.comparing.spots import most_different_spot
from course.core.types import Floats32, Floats64, Mask
from course.errors import CourseError
from course.formats.pictures.display import linear_to_srgb8, srgb_to_linear

FEWEST = 4
"""Blocks that a picture needs."""

HALF_STEP = 2.0**-10
"""Distance of two neighbours among OpenEXR's half floats, as a share of their size, at most."""

FLOAT_STEP = 2.0**-14
"""The same for float32, with what a renderer's own sums and constants lose."""


@dataclass(frozen=True)
class Comparison:
    """The result of a comparison of two pictures a and b.

    Attributes
    ----------
    p_value : how often noise alone would show as much, or more; corrected for the number of blocks and channels
    p_block, p_all : the same of the most significant block alone, and of all large blocks together
    p_spot : the same of the spot of a few pixels that stands out most
    spot : its column and row
    mean_difference : of a - b, over usable pixels, for red, green and blue [radiance]
    mean : of both pictures there
    rmse : root-mean-square difference, over usable pixels and channels [radiance]
    block : column and row of the upper left pixel of the most significant block, large or small, its width and height
    channel : 0, 1 or 2, of that block
    block_difference : mean of a - b there [radiance]
    differing : share of the usable pixels that are not equal
    largest : the largest difference a - b of one pixel and channel [radiance], and the pixel's column and row
    blocks : large ones that were compared
    clipped : share of the pixels that were left out, for they or a neighbour are cut off at white
    coded : whether the pictures were compared as 8 bits show them
    """

    p_value: float
    p_block: float
    p_all: float
    p_spot: float
    spot: tuple[int, int]
    mean_difference: tuple[float, float, float]
    mean: tuple[float, float, float]
    rmse: float
    block: tuple[int, int, int, int]
    channel: int
    block_difference: float
    differing: float
    largest: tuple[float, int, int]
    blocks: int
    clipped: float
    coded: bool


def compare(a: Floats32, b: Floats32, coded: tuple[bool, bool] = (False, False)) -> Comparison:
    """Test the hypothesis that two independent pictures have the same mean.

    Raises CourseError: the pictures differ in size, or too little of them is left to compare.

    Parameters
    ----------
    a, b : (H, W, 3) float32, linear
    coded : whether each comes from a file that is cut off at white. Where one does and has 8 bits, the other is encoded
        and decoded likewise.
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
    steps = _step(a, eight), _step(b, eight)
    return _test(a.astype(np.float64), b.astype(np.float64), usable, steps)


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


def _step(linear: Floats32, eight: bool) -> float | None:
    """Distance of neighbouring values as a share of their size; None for the codes of 8 bits."""
    if eight:
        return None
    with np.errstate(all="ignore"):
        half = bool((linear.astype(np.float16) == linear).all())
    return HALF_STEP if half else FLOAT_STEP


def _test(
    a: Floats64, b: Floats64, usable: Mask, steps: tuple[float | None, float | None]
) -> Comparison:
    height, width = usable.shape
    if min(height, width) < SMALLEST:
        raise _too_small(width, height)
    large, small = (differences(a, b, usable, steps, blocks) for blocks in divide(height, width))
    kept = int((large.counted[:, 0] > 0).sum())
    if kept < FEWEST:
        raise _too_small(width, height, 1 - float(usable.mean()))
    p_all = together(large)
    by_block = [one.p_values(near) for one, near in ((large, False), (small, True))]
    least = [float(p.min()) * np.isfinite(p).sum() for p in by_block]
    chosen = int(np.argmin(least))
    tested, p = (large, small)[chosen], by_block[chosen]
    worst, channel = np.unravel_index(p.argmin(), p.shape)
    p_block = min(1.0, 2 * min(least))
    p_spot, *spot = most_different_spot(a, b, usable)
    difference: Any = (a - b)[usable]
    both: Any = 0.5 * (a + b)[usable]
    return Comparison(
        p_value=min(1.0, 3 * min(p_block, p_all, p_spot)),
        p_block=p_block,
        p_all=p_all,
        p_spot=p_spot,
        spot=(spot[0], spot[1]),
        mean_difference=tuple(difference.mean(axis=0).tolist()),
        mean=tuple(both.mean(axis=0).tolist()),
        rmse=float(np.sqrt((difference**2).mean())),
        block=tested.blocks.place(int(worst)),
        channel=int(channel),
        block_difference=float(tested.mean[worst, channel]),
        differing=float((difference != 0).any(axis=1).mean()),
        largest=_largest(a - b, usable),
        blocks=kept,
        clipped=1 - float(usable.mean()),
        coded=steps[0] is None,
    )


def _largest(difference: Floats64, usable: Mask) -> tuple[float, int, int]:
    """The largest of a picture (H, W, 3), with its sign, and its column and row."""
    size = np.where(usable[..., None], np.abs(difference), 0)
    row, column, channel = np.unravel_index(int(size.argmax()), size.shape)
    return float(difference[row, column, channel]), int(column), int(row)


def _too_small(width: int, height: int, clipped: float = 0.0) -> CourseError:
    left = f", {clipped:.0%} of them cut off at white or beside such pixels," if clipped else ""
    return CourseError(
        f"pictures of {width} x {height} pixels{left} leave fewer than {FEWEST} blocks of {SMALLEST} x {SMALLEST} to"
        " compare; render larger ones" + (", or as EXR" if clipped else "")
    )
