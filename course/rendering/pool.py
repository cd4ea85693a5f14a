"""Executors do the work of a render: threads here; a cluster's workers are another (``course.rendering.cluster``).

Embree and NumPy's loops run without the interpreter lock, so threads are enough.
"""

from __future__ import annotations

import os
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
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


class Execution:
    """One call of ``Executor.run``, as the threads that do the work share it with the one that waits.

    Attributes
    ----------
    work : what nobody has taken yet
    film : takes in what is done
    lock : for all that threads change here
    working : threads that haven't ended
    finished : set when there is none
    stop : nothing more is wanted
    whole : all work was done
    error : that ended it
    """

    def __init__(self, work: Iterable[Work], film: AnyFilm, threads: int) -> None:
        self.work = iter(work)
        self.film = InOrder(film)
        self.lock = threading.Lock()
        self.working = threads
        self.finished = threading.Event()
        self.stop = self.whole = False
        self.error: BaseException | None = None


class Executor(ABC):
    """Has work done by threads, while the one that calls looks after progress, time and Ctrl-C.

    Parameters
    ----------
    servers : threads of this process that do work, or see to its being done elsewhere
    grace : seconds in which each must have ended when nothing more is wanted; None waits until it has

    Attributes
    ----------
    counters : of all work that was done, after each run
    interrupted : Ctrl-C was pressed
    deadline : ``time.monotonic()`` after which no tile is begun
    """

    def __init__(self, servers: int, grace: float | None = None) -> None:
        self._servers, self._grace = servers, grace
        self.counters = Counters()
        self.interrupted = False
        self.deadline = inf
        self._time_limit = inf

    @property
    @abstractmethod
    def threads(self) -> int:
        """How many threads render."""

    @abstractmethod
    def _serve(self, run: Execution) -> None:
        """In a thread of its own: do work, and have it taken in by the film, until there is none or it is too late."""

    def run(
        self, work: Iterable[Work], film: AnyFilm, tick: Tick = lambda _done, _first: None
    ) -> bool:
        """Have work done in order and taken in by the film; whether all of it was.

        Parameters
        ----------
        tick : called now and then from this thread

        Raises
        ------
        Exception
            What a thread, or a worker of a cluster, raised.
        """
        run = Execution(work, film, self._servers)
        threads = [
            threading.Thread(target=self._worker, args=(run,), name=f"tiles-{number}", daemon=True)
            for number in range(self._servers)
        ]
        try:
            for thread in threads:
                thread.start()
            while not run.finished.wait(TICK):
                tick(run.film.done, run.film.done_first)
        except KeyboardInterrupt:
            self.interrupted = True
        finally:
            run.stop = True
            for thread in threads:
                thread.join(self._grace)
        if self.interrupted:
            return False
        if run.error is not None:
            raise run.error
        tick(run.film.done, run.film.done_first)
        return run.whole

    def _worker(self, run: Execution) -> None:
        try:
            self._serve(run)
        except CancelledError:
            pass
        except BaseException as error:  # noqa: BLE001 - handed to the thread that waits
            run.error = run.error or error
            run.stop = True
        with run.lock:
            run.working -= 1
            if run.working == 0:
                run.finished.set()

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
    def left(self) -> float:
        """Seconds until the deadline; infinite where there is none."""
        return self.deadline - monotonic()

    @property
    def elapsed(self) -> float:
        """The share of the time limit that has passed; 0 where there is none."""
        return min(1.0 - self.left / self._time_limit, 1.0) if self.left < inf else 0.0

    def batches(self, most: int) -> int:
        """Batches of rays that a tile should have, where it may have so many."""
        return min(most, HURRIED) if self.left < inf else most


class Pool(Executor):
    """So many threads of this process, which take tiles one by one."""

    def __init__(self, tracer: Tracer, threads: int) -> None:
        super().__init__(servers=threads)
        self._tracer = tracer

    @property
    def threads(self) -> int:
        """How many threads render."""
        return self._servers

    def _serve(self, run: Execution) -> None:
        counters = Counters()
        try:
            while (work := self._take(run)) is not None:
                pixels, weight = self._tracer.render_tile(
                    work.tile, work.first, work.samples, counters, lambda: run.stop, work.parts
                )
                counters.start()
                run.film.add(work, pixels, weight)
                counters.lap("film")
        finally:
            with run.lock:
                self.counters.add(counters)

    def _take(self, run: Execution) -> Work | None:
        if run.stop or self.left < 0:
            return None
        with run.lock:
            work = next(run.work, None)
            run.whole = run.whole or work is None
            return work
