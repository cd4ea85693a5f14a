"""The executor of one machine: threads that render tiles; ``cluster.executor`` uses the workers of a cluster.

Embree and NumPy's loops release the interpreter lock, so threads are enough.
"""

import os
import threading
from abc import abstractmethod
from collections.abc import Iterable
from math import inf
from time import monotonic

from course.engine.core.counters import Counters
from course.engine.core.film import AnyFilm
from course.engine.core.integrator import CancelledError
from course.engine.core.schedule import Executor, Tick
from course.engine.core.tiles import Work
from course.engine.core.tracer import Tracer
from course.engine.core.types import Floats32
from course.engine.render.endless import LongCalls, end_endless

TICK = 0.05
"""Seconds between two checks of progress and Ctrl-C in the main thread."""

LOOK = 1.0
"""Seconds between two looks for a function that doesn't come back."""

HURRIED = 4
"""Most batches of rays in a tile under a time limit. A tile that has begun is finished, so tiles are kept small."""

LEAST_FOR_RAYS = 0.1
"""Least share of a time limit that is kept for rays, however long reading and building took."""


def default_threads() -> int:
    """Number of cores available to this process."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0)) or 1
    return os.cpu_count() or 1


class Execution:
    """State of one ``Executor.run``, shared by the threads that work and the one that waits.

    Attributes
    ----------
    work : work not yet taken
    film : receives finished work
    lock : guards what threads change here
    working : number of threads that haven't ended
    finished : set when all threads have ended
    stop : true if threads shall stop
    complete : true if all work was done
    error : raised by a thread
    """

    def __init__(self, work: Iterable[Work], film: AnyFilm, threads: int) -> None:
        self.work = iter(work)
        self.film = InOrder(film)
        self.lock = threading.Lock()
        self.working = threads
        self.finished = threading.Event()
        self.stop = self.complete = False
        self.error: BaseException | None = None


class ThreadedExecutor(Executor):
    """Runs work in threads, while the calling thread handles progress, time and Ctrl-C.

    Parameters
    ----------
    servers : number of threads of this process that render tiles, or hand them to workers elsewhere
    grace : longest wait for each thread to end [s]; None for no limit

    Attributes
    ----------
    counters : of all runs so far
    interrupted : true after Ctrl-C
    deadline : ``time.monotonic()`` after which no tile begins
    """

    def __init__(self, servers: int, grace: float | None = None) -> None:
        self._servers, self._grace = servers, grace
        self._long_calls = LongCalls()
        self.counters = Counters()
        self.interrupted = False
        self.deadline = inf
        self._time_limit = inf

    @abstractmethod
    def serve(self, run: Execution) -> None:
        """Do work and add it to the film, until none is left or the deadline has passed; runs in its own thread."""

    def run(
        self, work: Iterable[Work], film: AnyFilm, tick: Tick = lambda _done, _first: None
    ) -> bool:
        """Do the work in order and add it to the film; returns true if all of it was done.

        Raises Exception: raised by a thread or by a worker of a cluster.
        ``tick``: called every TICK seconds from this thread
        """
        run = Execution(work, film, self._servers)
        threads = [
            threading.Thread(target=self._worker, args=(run,), name=f"tiles-{number}", daemon=True)
            for number in range(self._servers)
        ]
        try:
            for thread in threads:
                thread.start()
            look = monotonic() + LOOK
            while not run.finished.wait(TICK):
                tick(run.film.done, run.film.done_first)
                if (now := monotonic()) >= look:
                    look = now + LOOK
                    self._long_calls.look(threads, now)
        except KeyboardInterrupt:
            self.interrupted = True
        finally:
            run.stop = True
            if self.interrupted:
                end_endless(threads)
            # Ctrl-C may have come before all were started.
            for thread in filter(threading.Thread.is_alive, threads):
                thread.join(self._grace)
        if self.interrupted:
            return False
        if run.error is not None:
            raise run.error
        tick(run.film.done, run.film.done_first)
        return run.complete

    def _worker(self, run: Execution) -> None:
        try:
            self.serve(run)
        except CancelledError:
            pass
        except BaseException as error:  # noqa: BLE001 - handed to the thread that waits
            run.error = run.error or error
            run.stop = True
        with run.lock:
            run.working -= 1
            if run.working == 0:
                run.finished.set()

    def close(self) -> None:
        """Release the resources of all runs."""

    def prepare(self) -> float:
        """Get ready; returns the earliest start of a time limit [``time.monotonic()``]."""
        return -inf

    def limit_time(self, seconds: float, since: float) -> None:
        """Set the deadline, at least ``seconds`` after ``since`` and after ``prepare()`` [``time.monotonic()``]."""
        self._time_limit = seconds
        self.deadline = max(since, self.prepare()) + seconds
        self.deadline = max(self.deadline, monotonic() + LEAST_FOR_RAYS * seconds)

    @property
    def seconds_left(self) -> float:
        """Seconds until the deadline; infinite if there is none."""
        return self.deadline - monotonic()

    @property
    def elapsed(self) -> float:
        """Share of the time limit that has passed; 0 if there is none."""
        return (
            min(1.0 - self.seconds_left / self._time_limit, 1.0) if self.seconds_left < inf else 0.0
        )

    def batches(self, most: int) -> int:
        """Batches of rays in a tile, at most ``most``."""
        return min(most, HURRIED) if self.seconds_left < inf else most


class Pool(ThreadedExecutor):
    """Threads of this process that take tiles one by one.

    ``tracer``: of the next tiles; it may be exchanged for one that makes the same bits
    """

    def __init__(self, tracer: Tracer, threads: int) -> None:
        super().__init__(servers=threads)
        self.tracer = tracer

    @property
    def threads(self) -> int:
        """Number of threads that render."""
        return self._servers

    def serve(self, run: Execution) -> None:
        """See ``ThreadedExecutor``."""
        counters = Counters()
        try:
            while (work := self._take(run)) is not None:
                pixels, weight = self.tracer.render_tile(
                    work.tile, work.first, work.samples, counters, lambda: run.stop, work.parts
                )
                counters.start()
                run.film.add(work, pixels, weight)
                counters.lap("film")
        finally:
            with run.lock:
                self.counters.add(counters)

    def _take(self, run: Execution) -> Work | None:
        if run.stop or self.seconds_left < 0:
            return None
        with run.lock:
            work = next(run.work, None)
            run.complete = run.complete or work is None
            return work


_Rendered = tuple[Work, Floats32, Floats32 | float]


class InOrder:
    """Adds work to a film. The passes of each tile are added in order; one that is finished early waits.

    A pass of a tile is complete when all its pieces have been added, in any order.
    Any number of threads may add at once; they add different tiles concurrently.
    ``done``, ``done_first``: pieces of work added so far, and those of the first pass
    """

    def __init__(self, film: AnyFilm) -> None:
        self._film = film
        self._lock = threading.Lock()
        self._next: dict[int, int] = {}
        self._missing: dict[int, int] = {}
        self._early: dict[tuple[int, int], list[_Rendered]] = {}
        self._adding: set[int] = set()
        self.done = 0
        self.done_first = 0

    def add(self, work: Work, pixels: Floats32, weight: Floats32 | float) -> None:
        """Add a piece of work, and all later pieces that waited for it."""
        tile = work.tile.number
        with self._lock:
            self._early.setdefault((tile, work.order), []).append((work, pixels, weight))
            # The thread that is adding to this tile adds this piece next.
            if tile in self._adding:
                return
            self._adding.add(tile)
        while True:
            with self._lock:
                order = self._next.get(tile, 0)
                ready = self._early.get((tile, order))
                if not ready:
                    self._adding.discard(tile)
                    return
                item, pixels, weight = ready.pop()
            self._film.add(item.tile, pixels, weight, item.first + item.samples, item.summed)
            size = item.tile.size
            with self._lock:
                self.done += 1
                self.done_first += item.order == 0
                missing = self._missing.pop(tile, item.pixels or size) - size
                if missing:
                    self._missing[tile] = missing
                else:
                    del self._early[tile, order]
                    self._next[tile] = order + 1
