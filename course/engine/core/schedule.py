"""Render a picture: a schedule chooses the work, an executor does it, and a film accumulates it.

The loop over the rays of a piece of work is ``Integrator.radiance`` in ``integrator.py``.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

from course.engine.core.counters import Counters
from course.engine.core.film import AnyFilm
from course.engine.core.tiles import Work, passes
from course.engine.core.tracer import Tracer

Progress = Callable[[float, bool], None]
"""Takes the fraction of the render that is done, in [0, 1], and a bool: true if every pixel has a sample."""

Tick = Callable[[int, int], None]
"""Called with the number of work items done, and with how many of them belong to the first pass."""


Run = Callable[..., bool]
"""Does the work of one round; returns true if all of it was done. Takes the work, and the fractions of the whole
render that are done before and after it, 0 and 1 by default.
"""


class Executor(ABC):
    """Renders work with ``Tracer.render_tile``, in any number of threads or processes, and adds it to a film.

    ``counters`` are those of all runs so far; ``interrupted`` is true after Ctrl-C.
    """

    counters: Counters
    interrupted: bool

    @property
    @abstractmethod
    def threads(self) -> int:
        """Number of threads that render."""

    @property
    @abstractmethod
    def seconds_left(self) -> float:
        """Seconds until the deadline, after which no work begins; infinite without a deadline."""

    @property
    @abstractmethod
    def elapsed(self) -> float:
        """Fraction of the time limit that has passed; 0 without a limit."""

    @abstractmethod
    def batches(self, most: int) -> int:
        """Number of batches of rays in a tile, at most ``most``."""

    @abstractmethod
    def run(self, work: Iterable[Work], film: AnyFilm, tick: Tick) -> bool:
        """Do the work, and add the passes of each tile in order; return true if all of it was done."""


class Schedule(ABC):
    """Chooses the work: uniform passes, or rounds that depend on the film."""

    @abstractmethod
    def render(self, run: Run, executor: Executor) -> bool:
        """Run all rounds; return true if the picture is complete."""

    def receipt(self) -> dict[str, Any]:
        """Entries that the schedule adds to the receipt."""
        return {}

    @property
    def note(self) -> str:
        """What is to be said of the picture while it is rendered; mostly nothing."""
        return ""


def render(
    film: AnyFilm, schedule: Schedule, executor: Executor, progress: Progress | None = None
) -> bool:
    """Render a picture into a film; return true if it is complete. ``progress`` is called from this thread.

    If ``progress`` has a method ``note``, it is told what the schedule has to say.
    """
    covered = False
    note = getattr(progress, "note", None)
    if note is not None and schedule.note:
        note(schedule.note)

    def run(work: Iterable[Work], done: float = 0.0, after: float = 1.0) -> bool:
        nonlocal covered
        # The length of an iterator is unknown. A render whose work comes from an iterator ends at the deadline, so its
        # progress is the fraction of the time limit.
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


@dataclass(frozen=True)
class UniformSchedule(Schedule):
    """All passes in one round. The film already holds ``done`` samples per pixel, a multiple of ``tiles.PASS``."""

    tracer: Tracer
    done: int = 0

    def render(self, run: Run, executor: Executor) -> bool:
        """See ``Schedule``."""
        return run(list(self.work(executor)))

    def work(self, executor: Executor) -> Iterator[Work]:
        """The pieces, pass by pass; in other sizes, or in parts, by other schedules."""
        batches = executor.batches(self.tracer.batches)
        return passes(self.tracer.settings, self.tracer.sampler, self.done, batches)
