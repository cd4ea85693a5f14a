"""Adaptive sampling: in rounds, samples go where the estimated error is, until the picture's is under a target.

All pixels get the same few samples first. After each round the film's estimates say which pixels need more, and how
many (``allocation``). The film alone decides, between the rounds, so the picture doesn't depend on the threads.
"""

import math
from typing import Protocol

import numpy as np

from course.engine.core.rays import RAYS
from course.engine.core.tiles import Work
from course.engine.core.types import Floats32, Indices, Numbers
from course.engine.render.adaptive.allocation import (
    FIRST,
    LADDER,
    best_samples,
    next_rung,
    one_rung_more,
    rung,
)
from course.engine.render.adaptive.audit import draw, judge, work_for
from course.engine.render.adaptive.film import PARTS, AdaptiveFilm
from course.engine.render.adaptive.pixel_groups import PixelGroup, nearby_order
from course.engine.terms.work import fair_share, spread_pixels

ADAPTABLE = ("sobol", "random", "xorshift")
"""Samplers that can go on where the error is, and whose samples tell it."""

CONCENTRATED = 100
"""Where fewer pixels than this have the error by what FIRST_OF_NET samples tell, all get FIRST: light is rare there."""

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

LARGEST = 2 * RAYS
"""Camera rays in a group of pixels at most: more than in a tile, for the hard pixels of a picture lose many of their
rays on the way."""

SHARES = 8
"""Of what is left of a round a group is one part in so many: large ones first, and small ones at the end, so that no
thread waits long for another."""


class Run(Protocol):
    """Does the work of a round; whether all of it was done."""

    def __call__(self, work: list[Work], done: float, after: float) -> bool:
        """``done``, ``after``: about the share of the whole render before and after this round."""
        ...


def render_adaptively(
    film: AdaptiveFilm,
    error: float,
    budget: int,
    groups: "RoundGroups",
    run: Run,
    first: int = FIRST,
) -> bool:
    """Add samples until the film's estimated error is at most ``error``; whether that was reached, or the budget spent.

    Parameters
    ----------
    error : root-mean-square error of the whole picture [radiance]
    budget : samples of all pixels together
    first : samples of each pixel in the first round, a rung of LADDER
    """
    try:
        _Rounds(film, error, budget, groups, run).render(first)
    except _InterruptedError:
        return False
    return True


class _InterruptedError(Exception):
    """A round wasn't finished."""


class _Rounds:
    """The rounds of one render; parameters as in ``render_adaptively``."""

    def __init__(
        self, film: AdaptiveFilm, error: float, budget: int, groups: "RoundGroups", run: Run
    ) -> None:
        self._film, self._error, self._budget = film, error, budget
        self._groups, self._run = groups, run
        self._order = nearby_order(film.width, film.height)
        self._have = film.samples.reshape(-1)
        self._cost = film.cost.reshape(-1)
        self._variance = film.variance.reshape(-1)
        self._audits = 0
        self._done = 0.0
        # Of the film alone, like everything between the rounds.
        self._rng = np.random.default_rng(0)

    def render(self, first: int) -> None:
        """Render all rounds."""
        count = len(self._have)
        wanted = np.full(count, min(first, max(self._budget // count, 1)), np.int32)
        # Nothing is known yet of how much there is to do.
        total = 4 * float(wanted.sum())
        self._add(wanted, total)
        self._end_round()
        if self._film.concentrated < CONCENTRATED and first < FIRST <= self._budget // count:
            self._add(np.full(count, FIRST, np.int32), 2 * total)
            self._end_round()
        while not self._enough():
            best = self._best()
            wanted = self._next(best)
            if (wanted == self._have).all() or self._round(wanted, best):
                return

    def _round(self, wanted: Numbers, best: Floats32) -> bool:
        """Render a round in parts of random pixels; whether the target was reached before its end."""
        have, film = self._have, self._film
        most = np.maximum(best, have)
        # Within the budget, which is of samples.
        most *= min(1, self._budget / float(most.sum()))
        total = _sum(np.maximum(most, wanted), self._cost)
        pixels, taken, begun = self._rng.permutation(np.flatnonzero(wanted > have)), 0, film.told
        while taken < len(pixels):
            goal = _look(self._audits) * self._error
            part = pixels[taken : taken + _part(film, pixels, taken, wanted, begun, goal)]
            reach = have.copy()
            reach[part] = wanted[part]
            self._add(reach, total)
            taken += len(part)
            if taken < len(pixels) and self._enough():
                return True
        self._end_round()
        return False

    def _add(self, wanted: Numbers, total: float) -> None:
        """Render pixels up to the samples (P,) that they shall have; ``total`` is what all rounds may cost."""
        have = self._have
        work = self._groups.stretches(have, wanted, self._order)
        share = _sum(wanted - have, self._cost) / (total - _sum(have, self._cost))
        self._do(work, self._done + (1 - self._done) * share)

    def _do(self, work: list[Work], after: float) -> None:
        if not self._run(work, self._done, after):
            raise _InterruptedError
        self._done = after

    def _end_round(self) -> None:
        variance, cost = self._film.end_round()
        self._variance, self._cost = variance.reshape(-1), cost.reshape(-1)

    def _enough(self) -> bool:
        """Audit where the told error has come near enough; whether the target is reached."""
        film, error = self._film, self._error
        while (passed := _passed(film.error / error)) > self._audits:
            self._audits = passed
            self._audit(AUDITED[passed - 1][1])
        return film.error <= error

    def _audit(self, share: float) -> None:
        """Correct the film's error by an audit, where it is worth one and paid for."""
        film, groups, number = self._film, self._groups, self._audits - 1
        sample = draw(film, number, share)
        if sample is None:
            return
        cost = int(sample.samples.sum())
        if cost > self._budget - film.audited - int(film.samples.sum()):
            return
        work = work_for(sample, film, number, groups.next_number)
        groups.next_number += len(work)
        self._do(work, self._done)
        judge(film, sample)
        film.audited += cost

    def _aim(self) -> float:
        """Mean variance that a round aims at, before what audits correct."""
        return (SAFETY * self._error) ** 2 / (self._film.correction * self._film.surplus)

    def _best(self) -> Floats32:
        """How many samples (P,) each pixel should have in the end."""
        return best_samples(self._variance, self._have, self._cost, self._film.order, self._aim())

    def _next(self, best: Floats32) -> Numbers:
        """How many samples (P,) each pixel shall have after the next round."""
        have, film = self._have, self._film
        wanted = next_rung(have, best)
        if (wanted == have).all():
            excess = (film.told / film.surplus - self._aim()) * len(have)
            wanted = one_rung_more(have, self._variance, self._cost, film.order, excess)
        return _within(wanted, have, best, self._budget - film.audited)


def _passed(ratio: float) -> int:
    """How many of AUDITED a ratio of the told error to the target has reached."""
    return sum(ratio <= level for level, _ in AUDITED)


def _look(audits: int) -> float:
    """How many times the target the told error shall be when a round is interrupted next, after so many audits."""
    return min(AUDITED[audits][0], CLOSE) if audits < len(AUDITED) else 1.0


def _part(
    film: AdaptiveFilm, pixels: Indices, taken: int, wanted: Numbers, begun: float, error: float
) -> int:
    """How many more of a round's pixels to render before the told error is looked at again.

    They are in random order, so the variance falls in proportion to how many were taken: by at most as much as for
    points whose error falls as 1 / n, and then by as much as it has been seen to fall.

    Parameters
    ----------
    taken : how many of ``pixels`` have been rendered in this round
    wanted : (P,) int32 samples of all pixels after it
    begun : what the film told before it
    error : at which to look
    """
    left = pixels[taken:]
    have = film.samples.reshape(-1)[left]
    now = film.told
    gain = (begun - now) / max(taken, 1)
    if not taken:
        # Of each pixel, as a part of what all have.
        variance = film.believed.reshape(-1)
        gains = variance[left] * (1 - (have / wanted[left]) ** 2)
        gain = now * float(gains.mean(dtype=np.float64) / variance.sum(dtype=np.float64))
    excess = now - error**2 / film.correction
    if excess >= gain * len(left):
        return len(left)
    return max(math.ceil(excess / gain), len(pixels) // FINEST, FEWEST)


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


class RoundGroups:
    """Divides the pixels of a round into groups that are rendered at once.

    Parameters
    ----------
    width : of the picture
    batches : of rays that a group should have where there are so many
    threads : that render
    smallest : camera rays that a group has at least, as far as pixels have so many samples to go
    """

    def __init__(
        self, width: int, batches: int = 1, threads: int = 1, smallest: int = RAYS
    ) -> None:
        self._width, self._smallest = width, smallest
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
            return min(max(left // SHARES, self._smallest), LARGEST)
        return min(max(fair_share(left, self._threads), self._smallest), self._batches * RAYS)
