"""Executors do the work of a render: threads here; a cluster's workers are another (``course.rendering.cluster``).

Embree and NumPy's loops run without the interpreter lock, so threads are enough.
"""

from __future__ import annotations

import os
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Sequence
from math import inf
from time import monotonic

from course.imaging.film import AnyFilm
from course.rendering.in_order import InOrder
from course.rendering.passes import Work
from course.transport.counters import Counters
from course.transport.tracing import CancelledError, Tracer

TICK = 0.05
"""Seconds between two looks of the main thread at progress and Ctrl-C."""

HURRIED = 4
"""Batches of rays in a tile where a time limit has to be kept; what has begun is finished first."""

LEAST_FOR_RAYS = 0.1
"""The share of a time limit that is left for rays, however long reading and building took."""

Tick = Callable[[int, int], None]
"""Called with the number of tiles done so far, and how many of them in the first pass."""


def default_threads() -> int:
    """As many as there are cores for this process."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0)) or 1
    return os.cpu_count() or 1


class Run:
    """The state of one run, which the threads that do the work share with the one that waits.

    Attributes
    ----------
    film : takes in what is done
    finished : set when nothing more comes
    stop : nothing more is wanted
    error : that ended it
    """

    def __init__(self, film: AnyFilm) -> None:
        self.film = InOrder(film)
        self.finished = threading.Event()
        self.stop = False
        self.error: BaseException | None = None


class Executor(ABC):
    """Has work done by threads, while the one that calls looks after progress, time and Ctrl-C.

    Attributes
    ----------
    counters : of all work that was done, after each run
    interrupted : Ctrl-C was pressed
    deadline : ``time.monotonic()`` after which no tile is begun
    """

    def __init__(self) -> None:
        self.counters = Counters()
        self.interrupted = False
        self.deadline = inf
        self._time_limit = inf

    @property
    @abstractmethod
    def threads(self) -> int:
        """How many threads render."""

    @abstractmethod
    def run(self, work: Iterable[Work], film: AnyFilm, tick: Tick | None = None) -> bool:
        """Do the work in order, and have it taken in by the film; whether all of it was done.

        Parameters
        ----------
        tick : called now and then from this thread
        """

    def close(self) -> None:  # noqa: B027 - most hold nothing
        """Let go of what runs have used."""

    def prepare(self) -> float:
        """Get ready; a time limit doesn't begin to count before this moment [``time.monotonic()``]."""
        return -inf

    def limit_time(self, seconds: float, since: float) -> None:
        """Begin no tile after so many seconds from a moment on [``time.monotonic()``]."""
        self._time_limit = seconds
        self.deadline = max(since, self.prepare()) + seconds
        self.deadline = max(self.deadline, monotonic() + LEAST_FOR_RAYS * seconds)

    @property
    def limited(self) -> bool:
        """Whether there is a deadline."""
        return self.deadline < inf

    @property
    def left(self) -> float:
        """Seconds until the deadline; infinite where there is none."""
        return self.deadline - monotonic()

    @property
    def elapsed(self) -> float:
        """The share of the time limit that has passed; 0 where there is none."""
        return min(1.0 - self.left / self._time_limit, 1.0) if self.limited else 0.0

    def batches(self, most: int) -> int:
        """Batches of rays that a tile should have, where it may have so many."""
        return min(most, HURRIED) if self.limited else most

    def _attend(
        self,
        run: Run,
        threads: Sequence[threading.Thread],
        tick: Tick | None,
        grace: float | None = None,
    ) -> None:
        """Start the threads of a run and wait for its end.

        Parameters
        ----------
        grace : seconds in which each thread must have ended then; None waits until it has
        """
        for thread in threads:
            thread.start()
        try:
            while not run.finished.wait(TICK) and any(thread.is_alive() for thread in threads):
                if tick is not None:
                    tick(run.film.done, run.film.done_first)
        except KeyboardInterrupt:
            self.interrupted = True
        finally:
            run.stop = True
            for thread in threads:
                thread.join(grace)
        if tick is not None and run.error is None and not self.interrupted:
            tick(run.film.done, run.film.done_first)


class Pool(Executor):
    """So many threads of this process, which take tiles one by one."""

    def __init__(self, tracer: Tracer, threads: int) -> None:
        super().__init__()
        self._tracer = tracer
        self._threads = threads

    @property
    def threads(self) -> int:
        """How many threads render."""
        return self._threads

    def run(self, work: Iterable[Work], film: AnyFilm, tick: Tick | None = None) -> bool:
        """See ``Executor.run``."""
        run = _PoolRun(self._tracer, film, work, self.deadline)
        threads = [
            threading.Thread(target=run.worker, name=f"tiles-{number}", daemon=True)
            for number in range(self.threads)
        ]
        self._attend(run, threads, tick)
        if run.error is not None:
            raise run.error
        self.counters.add(run.counters)
        return run.exhausted and not self.interrupted


class _PoolRun(Run):
    """Work that threads take one by one, and what it has cost."""

    def __init__(
        self, tracer: Tracer, film: AnyFilm, work: Iterable[Work], deadline: float
    ) -> None:
        super().__init__(film)
        self._tracer = tracer
        self._work = iter(work)
        self._deadline = deadline
        self._lock = threading.Lock()
        self._working = 0
        self.counters = Counters()
        self.exhausted = False

    def worker(self) -> None:
        """Take work until there is none."""
        counters = Counters()
        with self._lock:
            self._working += 1
        try:
            while (work := self._take()) is not None:
                pixels, weight = self._tracer.render_tile(
                    work.tile, work.first, work.samples, counters, lambda: self.stop, work.parts
                )
                counters.start()
                self.film.add(work, pixels, weight)
                counters.lap("film")
        except CancelledError:
            pass
        except BaseException as error:  # noqa: BLE001 - handed to the thread that waits
            self.error = self.error or error
            self.stop = True
        with self._lock:
            self.counters.add(counters)
            self._working -= 1
            if self._working == 0:
                self.finished.set()

    def _take(self) -> Work | None:
        if self.stop or monotonic() > self._deadline:
            return None
        with self._lock:
            work = next(self._work, None)
            if work is None:
                self.exhausted = True
            return work
