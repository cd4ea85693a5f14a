"""The told error, held against a second picture of a few pixels by points that had no part in anything before.

What a film tells of its own error may be wrong in three ways. Pixels that happened to find nothing were left as they
were, and count as done. Rare light that no pixel has found is in nobody's estimate. And how fast the error falls with
the samples isn't one power of their number: for points that are a net in four dimensions it falls in steps, by more
where the number is a power of 4.

So some pixels are rendered a second time, each with as many samples. Their points are as independent of the first as
another seed's. If A and B are the two means, E (A - B)^2 is the squared error of A and that of B together, whatever the
points and whatever has decided on the pixel. Pixels are chosen in proportion to the variance that they are told to
have, for then each tells as much, and some evenly, for the rest.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from course.core.types import Floats64, Indices, Numbers
from course.imaging.adaptive_film import PARTS, AdaptiveFilm
from course.imaging.pixel_groups import TwinGroup
from course.imaging.tiles import RAYS
from course.rendering.allocation import LADDER, LONGEST
from course.rendering.passes import Work

PIXELS = 256
"""Drawn for an audit at most; the told error is then certain to about 6%, and much less so where light is rare."""

FEWEST = 32
"""Drawn for an audit at least; where they would cost more than SHARE there is none."""

SHARE = 1 / 16
"""Of all samples so far, what an audit may take."""

EVENLY = 0.25
"""Of the pixels, drawn without regard to what they are told to have."""

DOUBT = 0.3, 0.2
"""Standard deviation of the logarithm of the variance that a film tells, over scenes: by itself, and after an audit."""


@dataclass(frozen=True)
class Sample:
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


def draw(film: AdaptiveFilm, number: int) -> Sample | None:
    """Choose pixels for the audit of that number; None where the picture has too few samples yet to pay for one."""
    variance, have = film.variance.reshape(-1).astype(np.float64), film.samples.reshape(-1)
    total = float(variance.sum())
    if total == 0:
        return None
    chance = (1 - EVENLY) / total * variance + EVENLY / len(have)
    # A stretch is at most as long as a table of points; more samples would tell little more of A.
    samples = np.minimum(have, LONGEST)
    each = float((chance * samples).sum())
    count = int(min(PIXELS, SHARE * float(have.sum(dtype=np.int64)) / each))
    if count < FEWEST:
        return None
    # Of the film alone, like everything between the rounds: the same numbers whatever the scene's seed.
    rng = np.random.default_rng(number)
    where = np.searchsorted(np.cumsum(chance), rng.random(count)).clip(0, len(have) - 1)
    pixels, drawn = np.unique(where, return_counts=True)
    return Sample(pixels.astype(np.intp), drawn.astype(np.float64), chance[pixels], samples[pixels])


def work_for(sample: Sample, film: AdaptiveFilm, number: int, first: int) -> list[Work]:
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


def judge(film: AdaptiveFilm, sample: Sample, number: int) -> float:
    """By what the told variance of the picture is to be multiplied, from the second pictures that the film has now.

    The audit and what was told before it are two opinions, whose logarithms are averaged by their certainty.
    """
    told = film.variance.reshape(-1).astype(np.float64)
    apart = film.twins_apart(sample.pixels)
    # B may have fewer samples than A, and a larger variance then.
    a = film.samples.reshape(-1)[sample.pixels] / sample.samples
    squared = apart / (1 + a ** (2 * film.order))
    terms = np.repeat(squared / sample.chance, sample.drawn.astype(np.int64)) / told.sum()
    mean, count = float(terms.mean()), len(terms)
    if mean <= 0:
        return film.correction
    doubt = float(terms.var()) / (count * mean * mean)
    before = DOUBT[min(number, 1)] ** 2
    share = before / (before + doubt)
    # The logarithm of an uncertain mean is too small by half its variance. Twice that is added, for a film that stops
    # where it is told little has heard the luckier ones.
    return math.exp(share * (math.log(mean) + doubt) + (1 - share) * math.log(film.correction))
