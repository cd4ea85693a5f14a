"""The pixels that get more samples, so that the picture's error falls below a target with as few samples as possible.

If a pixel's variance is v n^-2a and a sample of it costs c, the sum over all pixels is smallest for a given cost where
n is proportional to (v / c)^(1 / (2a + 1)): the derivative of the variance by the cost is then the same everywhere.
Some pixels have more samples than that already; the others share what is left of the target.

Costs differ: a sample of the sky is one ray, one of a mirror or of glass may be twenty. Where hard pixels cost as much
as the others, looking at it gains nothing.
"""

import math
import sys

import numpy as np

from course.engine.core.types import Floats32, Numbers
from course.engine.render.adaptive.film import PARTS

FIRST = 8
"""Independent samples that every pixel gets first. With 4, rare light would be darkened by a third."""

FIRST_OF_NET = 4
"""... and points of a net, which tell as much sooner: with 8 the six effects need 4 to 28% more in all. Where few
pixels have the error by what these tell, all get FIRST (``rounds.CONCENTRATED``)."""

LONGEST = 1024
"""Samples of a pixel between two rungs: as many as one table of points holds."""

KNOWN = 16
"""From so many samples on a pixel's variance is known well enough to take larger steps."""

GROWTH = 2, 4
"""By what a pixel's samples may grow in one round, below KNOWN and from there on. More would be decided on too little
knowledge, and each further round is one more chance to stop too early. With 2 throughout, 42 of 70 runs on six scenes
ended within a tenth of what was asked, with 4 from 16 samples on 60, from 32 on 59, with 3 throughout 47."""


def _ladder(most: int) -> Numbers:
    rungs = [FIRST_OF_NET]
    while rungs[-1] < most:
        last = rungs[-1]
        # 16, 24, 32, 48, 64, 96, ...: every second one a power of two, where the points are most even. A stretch has
        # PARTS equal parts, so the first steps are that long.
        step = last // 2 if last & (last - 1) == 0 else last // 3
        rungs.append(last + max(PARTS, min(step, LONGEST)))
    return np.array(rungs, np.int32)


LADDER = _ladder(65536)
"""The numbers of samples that a pixel may have: few different ones, so that many pixels go on together."""

# For each whole number of samples, the rung at or below it and the one next to it (in the logarithm): looked up many
# times for each pixel of a picture, which takes a tenth of a search.
_COUNTS = np.arange(LADDER[-1] + 1)
_RUNG = (np.searchsorted(LADDER, _COUNTS, "right") - 1).clip(0).astype(np.uint8)
_NEAREST = LADDER.take(
    np.searchsorted(np.sqrt(LADDER[:-1] * LADDER[1:].astype(np.float64)), _COUNTS)
)

_LAST_BITS = 16
"""Of a float32 that are left out to sort numbers by the others: 128 to an octave."""


def rung(samples: Numbers) -> Numbers:
    """Place in LADDER (P,) of numbers of samples (P,) that are all in it."""
    return _RUNG.take(samples).astype(np.int32)


def best_samples(
    variance: Floats32, samples: Numbers, cost: Floats32, order: float, target: float
) -> Floats32:
    """Number of samples that each pixel should have in the end.

    Parameters
    ----------
    variance : (P,) float32 [radiance^2], with the samples it has
    samples : (P,) int32
    cost : (P,) float32, of a sample
    order : of convergence
    target : the mean variance that the picture shall have

    Returns
    -------
    (P,) float32, any positive numbers; some are smaller than ``samples``
    """
    n = samples.astype(np.float32)
    # n = k w with w = (v / c)^(1 / (2a + 1)) leaves v n^-2a = k^-2a c w.
    w = (variance / cost * n ** np.float32(2 * order)) ** np.float32(1 / (2 * order + 1))
    best: Floats32 = w * np.float32(_level(variance, n, cost, w, order, target))
    return best


def growth(samples: Numbers) -> Floats32:
    """By what the samples (P,) of pixels may grow in one round."""
    return np.where(samples < KNOWN, *map(np.float32, GROWTH))


def next_rung(samples: Numbers, best: Floats32) -> Numbers:
    """The samples (P,) int32 that each pixel shall have after the next round; as many as now where it is done."""
    reachable = np.minimum(best, growth(samples) * samples.astype(np.float32)).astype(np.int32)
    highest = LADDER.take(_RUNG.take(np.minimum(samples + np.int32(LONGEST), LADDER[-1])))
    wanted: Numbers = np.clip(_NEAREST.take(np.minimum(reachable, LADDER[-1])), samples, highest)
    return wanted


def one_rung_more(
    samples: Numbers, variance: Floats32, cost: Floats32, order: float, excess: float
) -> Numbers:
    """The samples (P,) int32 after a round in which no pixel goes up by more than one rung of LADDER.

    For the end of a render, when no pixel is as much as half a rung away from the best. Those go up that gain the most
    for what they cost, and only as many as bring the sum of all variances down by ``excess`` [radiance^2].
    """
    above = LADDER.take(np.minimum(rung(samples) + 1, len(LADDER) - 1))
    gain = variance * (1 - (samples / above) ** (2 * order))
    promising = np.argsort(-gain / (cost * (above - samples + (above == samples))), kind="stable")
    enough = 1 + int(np.searchsorted(np.cumsum(gain.take(promising)), excess))
    chosen = promising[:enough]
    result = samples.copy()
    # What has no variance, or is at the top of the ladder, gains nothing.
    chosen = chosen[gain.take(chosen) > 0]
    result[chosen] = above[chosen]
    return result


def _level(
    variance: Floats32, n: Floats32, cost: Floats32, w: Floats32, order: float, target: float
) -> float:
    """The k for which max(n, k w) samples bring the mean variance down to the target, by bisection in its logarithm.

    What grows at a k is found for all pixels at once, by the first bits of the k from which on each grows; so the
    bisection looks only at those between two such numbers.
    """
    some = np.flatnonzero(w > 0)
    # A target may be so small that its square is 0.
    allowed = max(target * len(n), sys.float_info.min)
    if len(some) == 0:
        return 0.0
    variance, w = variance.take(some), w.take(some)
    ratio = n.take(some) / w
    # What n = w would leave.
    unit = cost.take(some) * w
    low: float = float(ratio.min())
    # Where everything grows, k^-2a sum(c w) is left; no k needs to be larger than that one, nor than the one that
    # brings every pixel to the top of the ladder.
    high = math.pow(float(unit.sum(dtype=np.float64)) / allowed, 1 / (2 * order))
    high = max(low, min(high, float(LADDER[-1] / w.min())))
    first_bits = ratio.view(np.int32) >> _LAST_BITS
    begin = first_bits.min()
    first_bits -= begin
    edges = (np.arange(first_bits.max() + 2, dtype=np.int32) + begin << _LAST_BITS).view(np.float32)
    below = [
        np.concatenate(([0.0], np.cumsum(np.bincount(first_bits, values))))
        for values in (variance, unit)
    ]
    above = below[0][-1] - below[0]
    left = above + edges.astype(np.float64) ** (-2 * order) * below[1]
    place = max(int(np.searchsorted(-left[:-1], -allowed)) - 1, 0)
    low = min(max(low, float(edges[place])), high)
    if place + 2 < len(edges):
        high = max(low, min(high, float(edges[place + 1])))
    inside = np.flatnonzero(first_bits == place)
    ratio, variance, unit = ratio.take(inside), variance.take(inside), unit.take(inside)
    for _ in range(24):
        k = math.sqrt(low * high)
        growing = ratio < k
        # No dot products: BLAS would start threads for them, which then spin where rays could be traced.
        stays = above[place + 1] + float(variance.sum(where=~growing, dtype=np.float64))
        grows = below[1][place] + float(unit.sum(where=growing, dtype=np.float64))
        low, high = (k, high) if stays + math.pow(k, -2 * order) * grows > allowed else (low, k)
    return high
