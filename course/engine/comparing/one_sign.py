"""Counts cells of a picture in which the difference of two pictures has one sign in each pixel.

Of independent noise whose sign is even, a cell of n pixels has one sign with the probability 2 / 2^n. That is rare, so
many such cells differ by something, even if from cell to cell it turns its sign, and by however much.
"""

import numpy as np

from course.engine.comparing.windows import CELL, Grid
from course.engine.core.types import Floats64, Mask

UNEVEN = 0.6
"""How often noise may have its likelier sign: it is a little skewed where one picture has more samples."""


def of_one_sign(d: Floats64, rounding: Floats64, own: slice, strip: Grid) -> Mask:
    """Which cells (down, across, 3) of some rows are so; differences (H, W, 3) that rounding explains have no sign."""
    signs = np.sign(d) * (np.abs(d) > rounding)
    pixels = np.multiply.outer(np.diff(strip.rows), np.diff(strip.columns))
    sums = [np.abs(strip.cells(signs[own][..., c])) for c in range(3)]
    return np.stack([one == pixels for one in sums], axis=-1)


def p_value(cells: Mask, inflation: float) -> float:
    """How often noise makes as many cells (down, across, 3) of one sign, in any channel.

    ``inflation``: by what the variance of sums is larger, for neighbours are alike; there are as many fewer pixels.
    """
    from scipy.special import pdtrc

    chance = min(1.0, 2 * UNEVEN ** (CELL**2 / inflation))
    expected = cells.shape[0] * cells.shape[1] * chance
    most = int(cells.sum(axis=(0, 1)).max())
    return min(1.0, 3 * float(pdtrc(most - 1, expected))) if most else 1.0
