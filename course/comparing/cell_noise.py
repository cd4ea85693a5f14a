"""What makes the mean of a block's cells less certain than their spread says: cells that are alike, and rounding."""

from __future__ import annotations

import numpy as np

from course.comparing.pixel_blocks import CELLS
from course.core.types import Floats64


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

    Parameters
    ----------
    step : distance of two neighbouring values as a share of their size; None for the codes of 8 bits
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
