"""Student's t for the difference of two pictures in each block, and for all blocks together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.comparing.cell_noise import alike, correlation, rounding_variance
from course.comparing.pixel_blocks import CELLS, Blocks
from course.core.types import Floats64, Mask

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
    a: Floats64,
    b: Floats64,
    usable: Mask,
    steps: tuple[float | None, float | None],
    blocks: Blocks,
) -> Tested:
    """What each block tells of two pictures a and b, (H, W, 3) each.

    Parameters
    ----------
    usable : (H, W) pixels that count
    steps : as `course.comparing.cell_noise.rounding_variance` takes them, of a and of b
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
