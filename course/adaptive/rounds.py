"""Adaptive sampling: in rounds, samples go where the estimated error is, until the picture's is under a target.

All pixels get the same few samples first. After each round the film's estimates say which pixels need more, and how
many (``allocation``). The film alone decides, between the rounds, so the picture doesn't depend on the threads.
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np

from course.adaptive.allocation import (
    FIRST,
    GROWTH,
    LADDER,
    best_samples,
    next_rung,
    one_rung_more,
    rung,
)
from course.adaptive.audit import draw, judge, work_for
from course.adaptive.film import PARTS, AdaptiveFilm
from course.adaptive.pixel_groups import PixelGroup, nearby_order
from course.adaptive.smoothing import Guide, smoothed
from course.core.rays import RAYS
from course.core.tiles import Work
from course.core.types import Floats32, Indices, Numbers
from course.extras.work import fair_share, spread_pixels

ADAPTABLE = ("sobol", "random", "xorshift")
"""Samplers that can go on where the error is, and whose samples tell it."""

SAFETY = 0.97
"""Part of the target that a round aims at, so that the last one doesn't miss it by a hair and another must follow."""

AUDITED = ((math.inf, 1 / 16), (2.5, 1 / 16), (1.3, 1 / 12), (1.1, 1 / 8))
"""An audit follows where the told error is at most so many times the target, and takes at most such a share of the
samples so far. The last is the most certain, and none comes after it: to go on until an audit says that it is enough
would be to wait for a lucky one. It comes before the end, since what was spent too much can't be taken back."""

CLOSE = 1.5
"""So many times the target a round is interrupted, too: by then a power law may be off by as much."""

FINEST = 64
"""Parts at most into which a round is divided where its end may be beyond the target. The parts are random, so that
where it stops doesn't depend on what single pixels have found, and rare light gets no darker than by whole rounds."""

FEWEST = 8
"""Pixels of such a part at least: each look at them is one more chance to stop too early. Where light is rare a few
dozen pixels have most of the error, and with 64 of them in a part the target was missed by a fifth."""

SMALLEST, LARGEST = RAYS, 2 * RAYS
"""Camera rays in a group of pixels, as far as pixels have so many samples to go: more than in a tile, for the hard
pixels of a picture lose many of their rays on the way."""

SHARES = 8
"""Of what is left of a round a group is one part in so many: large ones first, and small ones at the end, so that no
thread waits long for another."""


class Run(Protocol):
    """Does the work of a round; whether all of it was done."""

    def __call__(self, work: list[Work], done: float, after: float) -> bool:
        """``done``, ``after``: about the share of the whole render before and after this round."""
        ...


def render_adaptively(
    film: AdaptiveFilm, error: float, budget: int, groups: Groups, run: Run, first: int = FIRST
) -> bool:
    """Add samples until the film's estimated error is at most ``error``; whether that was reached, or the budget spent.

    Parameters
    ----------
    error : root-mean-square error of the whole picture [radiance]
    budget : samples of all pixels together
    first : samples of each pixel in the first round, a rung of LADDER
    """
    order = nearby_order(film.width, film.height)
    have = film.samples.reshape(-1)
    wanted = np.full(len(have), min(first, max(budget // len(have), 1)), np.int32)
    audits = 0
    # Of the film alone, like everything between the rounds.
    rng = np.random.default_rng(0)
    # Nothing is known yet of how much there is to do.
    done, total = 0.0, GROWTH * float(wanted.sum())
    cost = film.cost.reshape(-1)
    while True:
        pixels, taken, begun = rng.permutation(np.flatnonzero(wanted > have)), 0, _told(film)
        while taken < len(pixels):
            goal = _look(audits) * error
            part = pixels[taken : taken + _enough(film, pixels, taken, wanted, begun, goal)]
            reach = have.copy()
            reach[part] = wanted[part]
            work = groups.stretches(have, reach, order)
            share = _sum(reach - have, cost) / (total - _sum(have, cost))
            after = done + (1 - done) * share
            if not run(work, done, after):
                return False
            done = after
            taken += len(part)
            if taken == len(pixels):
                film.end_round()
            while (passed := _passed(film.error / error)) > audits:
                audits = passed
                if not _audit(film, audits - 1, budget, groups, run, done):
                    return False
            if film.error <= error:
                return True
        aim = (SAFETY * error) ** 2 / film.correction
        guide = Guide(film.linear, film.variance)
        variance = smoothed(film.variance, film.samples, film.order, guide).reshape(-1)
        cost = smoothed(film.cost, film.samples, 0, guide).reshape(-1)
        best = best_samples(variance, have, cost, film.order, aim)
        wanted = next_rung(have, best)
        if (wanted == have).all():
            excess = (film.error**2 / film.correction - aim) * len(have)
            wanted = one_rung_more(have, variance, cost, film.order, excess)
        wanted = _within(wanted, have, best, budget - film.audited)
        if (wanted == have).all():
            return True
        most = np.maximum(best, have)
        # Within the budget, which is of samples.
        most *= min(1, budget / float(most.sum()))
        total = _sum(np.maximum(most, wanted), cost)


def _passed(ratio: float) -> int:
    """How many of AUDITED a ratio of the told error to the target has reached."""
    return sum(ratio <= level for level, _ in AUDITED)


def _look(audits: int) -> float:
    """How many times the target the told error shall be when a round is interrupted next, after so many audits."""
    return min(AUDITED[audits][0], CLOSE) if audits < len(AUDITED) else 1.0


def _told(film: AdaptiveFilm) -> float:
    """Sum of the variances of all pixels, before what audits have corrected."""
    return float(film.variance.sum(dtype=np.float64))


def _enough(
    film: AdaptiveFilm, pixels: Indices, taken: int, wanted: Numbers, begun: float, error: float
) -> int:
    """How many more of a round's pixels to render before the told error is looked at again.

    They are in random order, so the variance falls in proportion to how many were taken: by at most as much as for
    points whose error falls as 1 / n, and then by as much as it has been seen to fall.

    Parameters
    ----------
    taken : how many of ``pixels`` have been rendered in this round
    wanted : (P,) int32 samples of all pixels after it
    begun : what ``_told`` said before it
    error : at which to look
    """
    left = pixels[taken:]
    have = film.samples.reshape(-1)[left]
    if not have[0]:
        return len(left)
    now = _told(film)
    gain = (begun - now) / max(taken, 1)
    if not taken:
        gains = film.variance.reshape(-1)[left] * (1 - (have / wanted[left]) ** 2)
        gain = float(gains.mean(dtype=np.float64))
    excess = now - error**2 / film.correction * film.variance.size
    if excess >= gain * len(left):
        return len(left)
    return max(math.ceil(excess / gain), len(pixels) // FINEST, FEWEST)


def _audit(
    film: AdaptiveFilm, number: int, budget: int, groups: Groups, run: Run, done: float
) -> bool:
    """Correct the film's error by an audit, where it is worth one and paid for; whether that was finished."""
    sample = draw(film, number, AUDITED[number][1])
    if sample is None:
        return True
    cost = int(sample.samples.sum())
    if cost > budget - film.audited - int(film.samples.sum()):
        return True
    work = work_for(sample, film, number, groups.next_number)
    groups.next_number += len(work)
    if not run(work, done, done):
        return False
    judge(film, sample)
    film.audited += cost
    return True


def _sum(samples: Numbers | Floats32, cost: Floats32) -> float:
    """The cost of some samples of each pixel."""
    # Not a dot product: for doubles BLAS would start threads, which then spin where rays could be traced.
    return float((samples * cost).sum(dtype=np.float64))


def _within(wanted: Numbers, have: Numbers, best: Floats32, budget: int) -> Numbers:
    """As much of what is wanted as the budget allows, the most urgent first."""
    cost = (wanted - have).astype(np.int64)
    left = budget - int(have.sum())
    if int(cost.sum()) <= left:
        return wanted
    urgent = np.argsort(-(best / have), kind="stable")
    kept = urgent[np.cumsum(cost.take(urgent)) <= left]
    result = have.copy()
    result[kept] = wanted[kept]
    return result


class Groups:
    """Divides the pixels of a round into groups that are rendered at once.

    Parameters
    ----------
    width : of the picture
    batches : of rays that a group should have where there are so many
    threads : that render
    """

    def __init__(self, width: int, batches: int = 1, threads: int = 1) -> None:
        self._width = width
        self.next_number = 0
        """Of the groups that were made so far, each of which has a number of its own."""
        self._batches, self._threads = batches, threads

    def stretches(self, have: Numbers, wanted: Numbers, order: Indices) -> list[Work]:
        """Work from the samples that the pixels have to those that they shall have, (P,) each.

        By samples, not by what they cost: dividing and ordering groups by that brought nothing on four scenes.
        """
        pixels = order[(wanted > have).take(order)]
        # Pixels with the same stretch to go can be rendered together.
        kind = rung(have.take(pixels)) * len(LADDER) + rung(wanted.take(pixels))
        kinds = [pixels[kind == number] for number in np.flatnonzero(np.bincount(kind))]
        steps = [int(wanted[chosen[0]] - have[chosen[0]]) for chosen in kinds]
        left = sum(len(chosen) * step for chosen, step in zip(kinds, steps, strict=True))
        work: list[Work] = []
        for place in sorted(range(len(kinds)), key=lambda place: -len(kinds[place]) * steps[place]):
            chosen, step = kinds[place], steps[place]
            first = int(have[chosen[0]])
            while len(chosen):
                most = max(self._most(left) // step, 1)
                # Equal groups rather than full ones and a rest.
                part = spread_pixels(-(-len(chosen) // -(-len(chosen) // most)), step)
                group = PixelGroup(self.next_number, chosen[:part], self._width)
                work.append(Work(group, 0, first, step, True, PARTS))
                self.next_number += 1
                left -= part * step
                chosen = chosen[part:]
        return work

    def _most(self, left: int) -> int:
        """Camera rays of a group, where so many are left of the round."""
        if self._batches == 1:
            # It may make a difference which pixels go together; so it doesn't matter how many threads there are.
            return min(max(left // SHARES, SMALLEST), LARGEST)
        return min(max(fair_share(left, self._threads), SMALLEST), self._batches * RAYS)
