"""Render: a schedule chooses the work, an executor does it, a film accumulates it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from math import inf
from typing import Any, Protocol

from course.core.film import AnyFilm
from course.core.passes import Work, passes
from course.core.threads import Executor
from course.core.tracer import Tracer

Progress = Callable[[float, bool], None]
"""Called with the share done, and true once the whole picture has been covered."""


class Run(Protocol):
    """Does the work of one round; returns true if all of it was done."""

    def __call__(self, work: Iterable[Work], done: float = 0.0, after: float = 1.0) -> bool:
        """``done``, ``after``: approximate share of the whole render before and after this round."""


class Schedule(ABC):
    """Chooses the work: uniform passes, or rounds that depend on the film."""

    @abstractmethod
    def render(self, run: Run, executor: Executor) -> bool:
        """Run all rounds; returns true if the picture is complete."""

    def receipt(self) -> dict[str, Any]:
        """Entries of the receipt that only this schedule has."""
        return {}


def render(
    film: AnyFilm, schedule: Schedule, executor: Executor, progress: Progress | None = None
) -> bool:
    """Render a picture into a film; returns true if it is complete. ``progress`` is called from this thread."""
    covered = False

    def run(work: Iterable[Work], done: float = 0.0, after: float = 1.0) -> bool:
        nonlocal covered
        # Work of unknown length lasts until the deadline; then only the clock gives the share.
        pieces = first_pass = inf
        if isinstance(work, Sequence):
            pieces, first_pass = max(len(work), 1), sum(item.order == 0 for item in work)

        def tick(count: int, count_first: int) -> None:
            if progress is not None:
                share = done + (after - done) * count / pieces
                progress(max(share, executor.elapsed), covered or count_first >= first_pass)

        complete = executor.run(work, film, tick)
        covered = covered or complete
        return complete

    return schedule.render(run, executor)


class UniformSchedule(Schedule):
    """All passes in one round; the film already holds ``done`` samples per pixel, a multiple of ``passes.PASS``."""

    def __init__(self, tracer: Tracer, done: int = 0) -> None:
        self._tracer = tracer
        self._done = done

    def render(self, run: Run, executor: Executor) -> bool:
        """See ``Schedule``."""
        return run(list(self._passes(executor)))

    def _passes(self, executor: Executor) -> Iterator[Work]:
        tracer = self._tracer
        batches = executor.batches(tracer.batches)
        return passes(tracer.settings, tracer.sampler, self._done, batches, executor.threads)
