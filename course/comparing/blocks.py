"""A picture in blocks of 4 x 4 cells of pixels, and Student's t for the difference of two pictures in each of them.

Small blocks are the cells of the large ones. The mean of a block's cells is less certain than their spread says where
cells are alike or rounded.
"""

import math
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats64, Indices, Mask

CELLS = 4
"""Cells along the side of a block."""

SMALLEST = 16
"""Pixels along the side of a block at least: cells of 4 x 4, wider than what reconstruction filters spread."""

MOST = 1024
"""Blocks at most, or nearly: in larger pictures they are larger. Among too many none can stand out."""


@dataclass(frozen=True)
class Blocks:
    """The borders of cells, CELLS x CELLS of which make a block: rows and columns of pixels, from 0 to the size."""

    rows: Indices
    columns: Indices

    @property
    def grid(self) -> tuple[int, int]:
        """Rows and columns of blocks."""
        return len(self.rows) // CELLS, len(self.columns) // CELLS

    def sums(self, values: Floats64) -> Floats64:
        """Sums (blocks, cells of a block, C) of values (H, W, C)."""
        by_rows = np.add.reduceat(values, self.rows[:-1], axis=0)
        sums = np.add.reduceat(by_rows, self.columns[:-1], axis=1)
        (down, across), channels = self.grid, sums.shape[2]
        sums = sums.reshape(down, CELLS, across, CELLS, channels).swapaxes(1, 2)
        return sums.reshape(down * across, CELLS * CELLS, channels)

    def place(self, number: int) -> tuple[int, int, int, int]:
        """Column and row of a block's upper left pixel, its width and height."""
        y, x = divmod(number, self.grid[1])
        top, bottom = (int(self.rows[CELLS * (y + k)]) for k in (0, 1))
        left, right = (int(self.columns[CELLS * (x + k)]) for k in (0, 1))
        return left, top, right - left, bottom - top


def divide(height: int, width: int) -> tuple[Blocks, Blocks]:
    """Large blocks and small ones, which are the large ones' cells; as equal as may be, with no pixel left over."""
    side = max(SMALLEST, math.ceil(math.sqrt(height * width / MOST)))
    large, small = (
        [
            np.linspace(0, size, cells * (size // side or 1) + 1).astype(np.intp)
            for size in (height, width)
        ]
        for cells in (CELLS, CELLS * CELLS)
    )
    return Blocks(*large), Blocks(*small)


def correlation(rest: Floats64) -> float:
    """Correlation of neighbouring cells, from what they exceed their block's mean by (blocks, cells, 3); at least 0.

    Samples that a filter shares between pixels make neighbours alike. The median over blocks isn't moved by a few in
    which something differs.
    """
    squares = (rest * rest).mean(axis=(1, 2))
    grid = rest.reshape(len(rest), CELLS, CELLS, 3)
    below = (grid[:, 1:] * grid[:, :-1]).mean(axis=(1, 2, 3))
    beside = (grid[:, :, 1:] * grid[:, :, :-1]).mean(axis=(1, 2, 3))
    seen = squares > 0
    if not seen.any():
        return 0.0
    r = float(np.median(0.5 * (below + beside)[seen] / squares[seen]))
    # With the block's mean m is taken away, the mean correlation of all its pairs: r = (rho - m) / (1 - m).
    rho = 0.0
    for _ in range(20):
        m = _mean_correlation(rho)
        rho = min(max(r * (1 - m) + m, 0.0), 0.9)
    return rho


def _mean_correlation(rho: float) -> float:
    """Of two cells of a block, be they the same or not, if that of neighbours is rho and falls off as a Gaussian."""
    k = np.arange(CELLS)
    powers = (k[:, None] - k) ** 2
    return float(np.mean(rho**powers)) ** 2


def alike(rho: float) -> float:
    """By what the variance of a block's mean exceeds the one that is estimated as if its cells were independent."""
    m = _mean_correlation(rho)
    return (CELLS * CELLS - 1) * m / (1 - m)


def rounding_variance(mean: Floats64, mean_square: Floats64, step: float | None) -> Floats64:
    """Variance (blocks, 3) of a block's mean by the rounding of its values, from means of the values and their squares.

    Values that spread over several steps are rounded up as often as down. Where a block is of one colour all are
    rounded alike, by up to half a step. Of values with the variance v [steps^2] the mean is off by e with
    E e^2 = exp(-4 pi^2 v) / 12, to the first term of the Fourier series of rounding.
    ``step``: distance of two neighbouring values as a share of their size; None for the codes of 8 bits.
    """
    if step is None:
        # The derivative of the sRGB curve, backwards, over 255.
        curve = 1.055 / 2.4 * np.maximum(mean, 1e-6) ** (1 / 2.4 - 1)
        size = 1 / (255 * np.where(mean <= 0.0031308, 12.92, curve))
    else:
        size = np.maximum(step * mean, 1e-30)
    v = np.maximum(mean_square - mean**2, 0) / size**2
    result: Floats64 = size**2 / 12 * np.exp(-4 * np.pi**2 * np.minimum(v, 10))
    return result


FEWEST_CELLS = 8
"""Usable ones that a block needs."""


@dataclass(frozen=True)
class Tested:
    """Blocks of one size; all arrays are (blocks, 3), those of blocks that don't count hold 0.

    Attributes
    ----------
    counted : cells that count
    mean : of the cells' differences
    variance : of that mean, by the cells' own spread, without rounding
    rounding : its variance by rounding
    differs : where the pictures aren't equal in all cells
    rho : correlation of neighbouring cells
    """

    blocks: Blocks
    counted: Floats64
    mean: Floats64
    variance: Floats64
    rounding: Floats64
    differs: Mask
    rho: float

    def t(self, variance: Floats64) -> Floats64:
        """Means over their standard errors; 0 where there is no difference, which tells nothing."""
        error = np.sqrt(variance + self.rounding)
        return np.divide(self.mean, error, out=np.zeros_like(error), where=self.differs)

    def p_values(self, near: bool) -> Floats64:
        """Of each block and channel by itself; not corrected for their number.

        ``near``: take its neighbours' spread where that is larger. Small blocks may have missed what makes the
        others noisy.
        """
        # Imported here: no other command needs SciPy's functions.
        from scipy.special import stdtr

        variance = np.maximum(self.variance, self._near()) if near else self.variance
        freedom = np.maximum(self.counted - 1, 1) / alike(self.rho)
        result: Floats64 = 2 * stdtr(freedom, -np.abs(self.t(variance)))
        return result

    def _near(self) -> Floats64:
        """Mean of the variances of a block and the eight around it."""
        down, across = self.blocks.grid
        some = (self.counted > 0).astype(np.float64)
        total, count = (
            sum(
                np.pad(values.reshape(down, across, 3), ((1, 1), (1, 1), (0, 0)))[
                    y : y + down, x : x + across
                ]
                for y in range(3)
                for x in range(3)
            )
            for values in (self.variance, some)
        )
        return np.asarray(total / np.maximum(count, 1)).reshape(-1, 3)


def differences(
    a: Floats64, b: Floats64, usable: Mask, steps: tuple[float | None, float | None], blocks: Blocks
) -> Tested:
    """Statistics of each block of two pictures a and b, (H, W, 3) each.

    Parameters
    ----------
    usable : (H, W) pixels that count
    steps : as `course.comparing.blocks.rounding_variance` takes them, of a and of b
    """
    weight = usable[..., None].astype(np.float64)
    pixels = blocks.sums(weight)
    # A cell counts if half of its pixels do.
    pixels[pixels < 0.5 * blocks.sums(np.ones_like(weight))] = 0
    counts = pixels > 0
    counts &= counts.sum(axis=1, keepdims=True) >= FEWEST_CELLS
    counted = np.repeat(counts.sum(axis=1), 3, axis=1).astype(np.float64)
    some = np.maximum(counted, 1)

    def cells(values: Floats64) -> Floats64:
        """Means (blocks, cells, 3); 0 where a cell doesn't count."""
        return np.where(counts, blocks.sums(values * weight) / np.maximum(pixels, 1), 0)

    def mean(values: Floats64) -> Floats64:
        result: Floats64 = cells(values).sum(axis=1) / some
        return result

    d = cells(a - b)
    of_d = d.sum(axis=1) / some
    rest = np.where(counts, d - of_d[:, None], 0)
    rho = correlation(rest)
    rounding = [
        rounding_variance(mean(one), mean(one * one), step)
        for one, step in zip((a, b), steps, strict=True)
    ]
    return Tested(
        blocks=blocks,
        counted=counted,
        mean=of_d,
        variance=(rest * rest).sum(axis=1) / (some * np.maximum(counted - 1, 1)) * alike(rho),
        rounding=rounding[0] + rounding[1],
        differs=np.abs(d).max(axis=1) > 0,
        rho=rho,
    )


def together(tested: Tested) -> float:
    """The p-value of all blocks together: of the most significant channel, times 3."""
    from scipy.special import stdtr

    variance = tested.variance + tested.rounding
    t = tested.t(tested.variance)
    kept = tested.counted[:, 0] > 0
    n = int(kept.sum())
    rounded = np.divide(
        tested.rounding, variance, out=np.zeros_like(variance), where=tested.differs
    )
    # Blocks of one colour are rounded alike, so these errors add up; the others' squares do. Neighbouring blocks share
    # what the cells along their border share.
    squares = (t * t).sum(axis=0) * (1 + 4 * tested.rho / (CELLS * alike(tested.rho)))
    squares += np.sqrt(rounded[kept]).sum(axis=0) ** 2
    total = np.abs(t.sum(axis=0)) / np.sqrt(np.where(squares > 0, squares, 1))
    # The T of n numbers is at most the root of n.
    student = total * np.sqrt((n - 1) / np.maximum(n - total**2, 1e-12))
    return min(1.0, 3 * float(2 * stdtr(n - 1, -student).min()))
