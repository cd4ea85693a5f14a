"""The told error, held against a second picture of a few pixels by points that had no part in anything before.

What a film tells of its own error may be wrong in three ways. Pixels that happened to find nothing were left as they
were, and count as done. Rare light that no pixel has found is in nobody's estimate. And how fast the error falls with
the samples isn't one power of their number: for points that are a net in four dimensions it falls in steps, by more
where the number is a power of 4.

So some pixels are rendered a second time, each with as many samples. Their points are as independent of the first as
another seed's. If A and B are the two means, E (A - B)^2 is the squared error of A and that of B together, whatever the
points and whatever has decided on the pixel.

The two needn't be alike. A pixel that found bright light by chance was sampled on until that was diluted, one that
found none was left with little error; B finds such light anew. Where light is rare B may have many times the error of
A. So the sum is divided as two estimates by one formula are: what the film tells of A, and what the quarters and halves
of B, on which nothing was decided, tell of B. By what both are wrong, as the power above, cancels; so does the light
that B alone has found, which is in the sum and in the estimate of B.
"""

import math
from dataclasses import dataclass

import numpy as np

from course.engine.core.rays import RAYS
from course.engine.core.tiles import Work
from course.engine.core.types import Floats64, Indices, Numbers
from course.engine.render.adaptive.allocation import LADDER, LONGEST
from course.engine.render.adaptive.film import PARTS, AdaptiveFilm
from course.engine.render.adaptive.pixel_groups import TwinGroup

PIXELS = 1024
"""Drawn for an audit at most; the told error is then certain to about 2%, and less so where light is rare."""

FEWEST = 32
"""Drawn for an audit at least; where they would cost more than its share there is none."""

EVENLY = 0.15
"""Of the pixels, drawn without regard to what they are told to have."""

POOLED = 5
"""Side of the square of pixels over which variances are averaged, half and half with a pixel's own, to be drawn by."""

QUIET = 0.2
"""Of the mean variance, below which pixels are drawn as if they had it: their estimates say little of their errors."""

ALIKE = 0.8
"""Logarithm of a ratio of two estimated variances from which on it is rather a difference than noise."""

STEEP = 8
"""How sharply: with 4, a second picture of three times the error counted as one of twice the error."""

DOUBT = 0.28
"""Standard deviation of the logarithm of the variance that a film tells by itself, over scenes."""

DRIFT = 0.2
"""Standard deviation that is added to it while the told variance falls by a factor e after an audit."""


@dataclass(frozen=True)
class AuditSample:
    """Pixels for an audit.

    Attributes
    ----------
    pixels : (m,) intp, each once
    drawn : (m,) how often each was drawn
    chance : (m,) of each in one draw
    samples : (m,) int32 that their second picture has
    """

    pixels: Indices
    drawn: Floats64
    chance: Floats64
    samples: Numbers


def draw(film: AdaptiveFilm, number: int, share: float) -> AuditSample | None:
    """Choose pixels for the audit of that number; None where the picture has too few samples yet to pay for one.

    What is drawn by chances p and costs c tells a sum of values x best where p is as sqrt(E x^2 / c).

    Parameters
    ----------
    share : of all samples so far, what the audit may take
    """
    have = film.samples.reshape(-1)
    variance = _pooled(film)
    mean = float(variance.mean())
    if mean == 0:
        return None
    # A stretch is at most as long as a table of points; more samples would tell little more of A.
    samples = np.minimum(have, LONGEST)
    best = np.sqrt((variance**2 + (QUIET * mean) ** 2) / samples)
    chance = (1 - EVENLY) / best.sum() * best + EVENLY / len(have)
    if len(film.foreseen):
        # A second picture of a pixel that finds a thing once in a thousand samples would tell nothing.
        chance[film.foreseen] = 0
        chance /= chance.sum()
    each = float((chance * samples).sum())
    count = int(min(PIXELS, share * float(have.sum(dtype=np.int64)) / each))
    if count < FEWEST:
        return None
    # Of the film alone, like everything between the rounds: the same numbers whatever the scene's seed.
    rng = np.random.default_rng(number)
    where = np.searchsorted(np.cumsum(chance), rng.random(count)).clip(0, len(have) - 1)
    pixels, drawn = np.unique(where, return_counts=True)
    return AuditSample(
        pixels.astype(np.intp), drawn.astype(np.float64), chance[pixels], samples[pixels]
    )


def _pooled(film: AdaptiveFilm) -> Floats64:
    """Variances (P,), half of each from the pixels around it as if they had as many samples."""
    n = film.samples.astype(np.float32)
    own = film.unforeseen * n
    sums = own
    for _ in range(2):
        # Along one axis, and after turning along the other; those at the edge count for what lies beyond.
        padded = np.pad(sums, ((POOLED // 2, POOLED // 2), (0, 0)), mode="edge")
        sums = np.sum([padded[start : start + len(sums)] for start in range(POOLED)], axis=0).T
    pooled = np.float32(0.5) * (own + sums * np.float32(1 / POOLED**2)) / n
    return pooled.reshape(-1).astype(np.float64)


def work_for(sample: AuditSample, film: AdaptiveFilm, number: int, first: int) -> list[Work]:
    """Render the pixels of a sample a second time.

    Parameters
    ----------
    number : of the audit, from 0
    first : number of the first group, all of which are different in a render
    """
    work: list[Work] = []
    shift = (number + 1) * film.width * film.height
    for samples in LADDER[np.isin(LADDER, sample.samples)].tolist():
        pixels = sample.pixels[sample.samples == samples]
        for start in range(0, len(pixels), max(RAYS // samples, 1)):
            part = pixels[start : start + max(RAYS // samples, 1)]
            group = TwinGroup(first + len(work), part, film.width, shift)
            work.append(Work(group, 0, 0, samples, True, PARTS))
    return work


def judge(film: AdaptiveFilm, sample: AuditSample) -> None:
    """Correct what the film tells, by the second pictures that it has now.

    The audit and what was told before it are two opinions, whose logarithms are averaged by their certainty.
    """
    told = film.told_by_samples
    apart, of_second = film.twins_apart(sample.pixels)
    # B may have fewer samples than A, and a larger variance then.
    a = film.samples.reshape(-1)[sample.pixels] / sample.samples
    larger = a ** (2 * film.order)
    count = float(sample.drawn.sum())
    weight = 1 / (sample.chance * film.samples.size)
    both = 2 / (1 + larger) * apart * weight
    second = of_second / larger * weight
    sum_of_both = float((both * sample.drawn).sum()) / count
    of_b = float((second * sample.drawn).sum()) / count
    if sum_of_both <= 0:
        return
    part, steepness = _part_of_first(told, of_b)
    mean = part * sum_of_both / told
    # Of the logarithm of the mean: what each pixel adds to it, of both sums, to first order.
    adds = both / sum_of_both - 1 - steepness * (second / max(of_b, _TINY) - 1)
    doubt = float((adds * adds * sample.drawn).sum()) / count**2
    before = film.doubt + DRIFT**2 * abs(math.log(told / film.judged)) if film.judged else DOUBT**2
    share = before / (before + doubt) if doubt else 1.0
    # The logarithm of an uncertain mean is too small by half its variance.
    log = share * (math.log(mean) + doubt / 2) + (1 - share) * math.log(film.correction)
    film.correction, film.doubt, film.judged = math.exp(log), share * doubt, told


_TINY = 1e-300


def _part_of_first(first: float, second: float) -> tuple[float, float]:
    """The part of the squared errors of A and B that is A's, by the variances that both are told to have.

    One half where they are alike. Only B may have more: nothing has made its errors smaller than they are.

    Returns
    -------
    tuple of float
        The part, and by how much its logarithm falls where that of ``second`` grows.
    """
    lead = math.log(second / first) if second > first else 0.0
    believed = lead**STEEP / (lead**STEEP + ALIKE**STEEP)
    part = 1 / (1 + math.exp(believed * lead))
    return part, (1 - part) * believed * (1 + STEEP * (1 - believed))
