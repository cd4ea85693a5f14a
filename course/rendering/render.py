"""Render: a schedule says what is to be done, an executor does it, a film takes it in."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from math import inf
from typing import Any, Protocol

from course.imaging.film import AnyFilm
from course.rendering.passes import Work
from course.rendering.pool import Executor

Progress = Callable[[float, bool], None]
"""Called with the share done, and whether the whole picture has been covered once."""


class Run(Protocol):
    """Has the work of one round done; whether all of it was."""

    def __call__(self, work: Iterable[Work], done: float = 0.0, after: float = 1.0) -> bool:
        """``done``, ``after``: about the share of the whole render before and after this round."""
        ...


class Schedule(ABC):
    """Decides what is rendered next: uniform passes, or rounds by what the film has taken in."""

    @abstractmethod
    def render(self, run: Run, executor: Executor) -> bool:
        """Have all rounds run; whether the picture is complete."""

    def receipt(self) -> dict[str, Any]:
        """Entries of the receipt that only such a schedule has."""
        return {}


def render(
    film: AnyFilm, schedule: Schedule, executor: Executor, progress: Progress | None = None
) -> bool:
    """Render a picture into a film; whether it is complete.

    Parameters
    ----------
    progress : called now and then from this thread
    """
    covered = False

    def run(work: Iterable[Work], done: float = 0.0, after: float = 1.0) -> bool:
        nonlocal covered
        # Work of unknown length goes on until the deadline; the clock alone knows the share then.
        pieces = first_pass = inf
        if isinstance(work, Sequence):
            pieces, first_pass = max(len(work), 1), sum(item.order == 0 for item in work)

        def tick(count: int, count_first: int) -> None:
            if progress is not None:
                share = done + (after - done) * count / pieces
                progress(max(share, executor.elapsed), covered or count_first >= first_pass)

        whole = executor.run(work, film, tick)
        covered = covered or whole
        return whole

    return schedule.render(run, executor)
