"""Variances of pixels that learn from their neighbours, as far as these show the same surface.

An estimate from a handful of samples is wrong by its own size: a pixel that happens to have found nothing yet looks
finished. Its neighbours know better, unless an edge lies between.
"""

import numpy as np

from course.engine.core.types import Floats32, Numbers

BLIND = 32
"""Samples up to which a pixel's own estimate counts no more than its neighbours do."""

LEAK = 0.1
"""Least share of a neighbour's binomial weight. Without it a pixel that has found nothing yet, and so differs from its
neighbours, would never learn of their variance."""

NOISE = 12.0
"""Squared differences of colours count as noise up to about so many times the variance of the difference. With 4 it is
as good on the scenes of the course, and rare light is darkened by a quarter."""

NO_NOISE = np.float32(1e-30)
"""Added to variances that are divided by, which may be 0."""

PAIRS = ((0, 1, 2), (1, 0, 2), (1, 1, 1), (1, -1, 1))
"""Rows and columns from a pixel to a neighbour, and its binomial weight; each two neighbours once."""

Window = tuple[slice, slice]
"""Rows and columns of a picture."""


class Guide:
    """Weights of a pixel's eight neighbours: binomial ones, times the LEAK where the colours differ by more than noise.

    Parameters
    ----------
    colours : (3, H, W) float32, the picture so far
    variance : (H, W) float32, estimated variance of each of its pixels
    """

    def __init__(self, colours: Floats32, variance: Floats32) -> None:
        noise = NOISE * _binomial(variance)
        # Each pair of neighbours once: the weights are the same both ways.
        self._pairs: list[tuple[Window, Window, Floats32]] = []
        self._total = np.full(variance.shape, 4, np.float32)
        for dy, dx, binomial in PAIRS:
            here, there = _windows(dy, dx)
            difference = colours[:, *here] - colours[:, *there]
            weight = np.einsum("chw,chw->hw", difference, difference)
            with np.errstate(over="ignore"):
                weight /= np.float32(-3) * (noise[here] + noise[there] + NO_NOISE)
            np.exp(weight, out=weight)
            weight *= np.float32(binomial * (1 - LEAK))
            weight += np.float32(binomial * LEAK)
            self._pairs.append((here, there, weight))
            self._total[here] += weight
            self._total[there] += weight

    def mean(self, values: Floats32) -> Floats32:
        """Means (H, W) over each pixel and its neighbours."""
        total = values * np.float32(4)
        for here, there, weight in self._pairs:
            total[here] += weight * values[there]
            total[there] += weight * values[here]
        total /= self._total
        return total


def smoothed(values: Floats32, samples: Numbers, order: float, guide: Guide) -> Floats32:
    """Variances (H, W) averaged with those that the eight neighbours would have with as many samples.

    The more samples beyond BLIND a pixel has, the less its neighbours count: else a noisy pixel alone, or an edge one
    pixel wide, would draw samples to those around it without end.

    Parameters
    ----------
    values : (H, W) float32, variances, or anything else that falls with the samples as n^-2 order
    """
    n = samples.astype(np.float32)
    scale = n ** np.float32(2 * order)
    own = values * scale
    mixed = guide.mean(own)
    mixed -= own
    mixed *= np.minimum(BLIND / n, np.float32(1))
    mixed += own
    mixed /= scale
    return mixed


def _windows(dy: int, dx: int) -> tuple[Window, Window]:
    """Parts of a picture that lie on each other when the second is moved by -dy rows and -dx columns."""
    here = slice(None, -dy or None), slice(max(-dx, 0), min(-dx, 0) or None)
    there = slice(dy, None), slice(max(dx, 0), min(dx, 0) or None)
    return here, there


def _binomial(values: Floats32) -> Floats32:
    """Means (H, W) over 3 x 3 pixels with weights 1 2 1 both ways."""
    v = np.pad(values, 1, mode="edge")
    rows = v[:-2] + v[2:] + 2 * v[1:-1]
    mean: Floats32 = (rows[:, :-2] + rows[:, 2:] + 2 * rows[:, 1:-1]) * np.float32(1 / 16)
    return mean
