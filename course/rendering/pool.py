"""Threads over tiles. Embree and NumPy's loops run without the interpreter lock, so threads are enough.

``Runner``, ``Run`` and ``InOrder`` are what such a pool has in common with a cluster's workers.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable, Sequence
from time import monotonic
from typing import Any, Protocol

from course.core.types import Floats32
from course.rendering.passes import Work
from course.transport.counters import Counters
from course.transport.tracing import CancelledError, Tracer

TICK = 0.05
"""Seconds between two looks of the main thread at progress and Ctrl-C."""

Tick = Callable[[int, int], None]
"""Called with the number of tiles done so far, and how many of them in the first pass."""


class Sink(Protocol):
    """A film, of any kind."""

    def add(
        self, tile: Any, mean: Floats32, weight: Floats32 | float, samples: int, whole: bool
    ) -> None:
        """Take in a piece of work."""
        ...


def default_threads() -> int:
    """As many as there are cores for this process."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0)) or 1
    return os.cpu_count() or 1


_Rendered = tuple[Work, Floats32, Floats32 | float]


class InOrder:
    """Hands work on to a film, the passes of a tile in their order even if a later one comes first.

    A pass of a tile is in the film when all its parts are, which may come in any order.

    Any number of threads may add at once; different tiles enter the film side by side.

    Attributes
    ----------
    done, done_first : tiles, or parts of them, that the film has taken in, and how many of them in the first pass
    """

    def __init__(self, film: Sink) -> None:
        self._film = film
        self._lock = threading.Lock()
        self._next: dict[int, int] = {}
        self._missing: dict[int, int] = {}
        self._early: dict[tuple[int, int], list[_Rendered]] = {}
        self._adding: set[int] = set()
        self.done = 0
        self.done_first = 0

    def add(self, work: Work, pixels: Floats32, weight: Floats32 | float) -> None:
        """Take in a piece of work, and whatever has waited for it."""
        tile = work.tile.number
        with self._lock:
            self._early.setdefault((tile, work.order), []).append((work, pixels, weight))
            # Somebody who is adding to this tile now will see this piece when done with the one before.
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
            self._film.add(item.tile, pixels, weight, item.first + item.samples, item.whole)
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


class Run:
    """The state of one run, which the threads that do the work share with the one that waits.

    Attributes
    ----------
    film : takes in what is done
    finished : set when nothing more comes
    stop : nothing more is wanted
    error : that ended it
    """

    def __init__(self, film: Sink) -> None:
        self.film = InOrder(film)
        self.finished = threading.Event()
        self.stop = False
        self.error: BaseException | None = None


class Runner:
    """Has work done by threads, while the one that calls looks after progress and Ctrl-C.

    Attributes
    ----------
    counters : of all work that was done, after each run
    interrupted : Ctrl-C was pressed
    """

    def __init__(self) -> None:
        self.counters = Counters()
        self.interrupted = False

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


class Pool(Runner):
    """Runs work on threads until it is done, the time is up, or somebody presses Ctrl-C.

    Attributes
    ----------
    threads : that render
    """

    def __init__(self, tracer: Tracer, film: Sink, threads: int) -> None:
        super().__init__()
        self._tracer = tracer
        self._film = film
        self.threads = threads

    def prepare(self, began: float) -> float:
        """When a time limit begins to count [``time.monotonic()``]: when the render was asked for."""
        return began

    def run(
        self,
        work: Iterable[Work],
        deadline: float | None,
        tick: Tick | None,
    ) -> bool:
        """Do the work in order; whether all of it was done.

        Parameters
        ----------
        deadline : ``time.monotonic()`` after which no tile is begun
        tick : called now and then from this thread
        """
        run = _PoolRun(self._tracer, self._film, work, deadline)
        threads = [
            threading.Thread(target=run.worker, name=f"tiles-{number}", daemon=True)
            for number in range(self.threads)
        ]
        self._attend(run, threads, tick)
        if run.error is not None:
            raise run.error
        self.counters.add(run.counters)
        return run.exhausted and not self.interrupted

    def close(self) -> None:
        """Nothing: each run ends its threads."""


class _PoolRun(Run):
    """Work that threads take one by one, and what it has cost."""

    def __init__(
        self, tracer: Tracer, film: Sink, work: Iterable[Work], deadline: float | None
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
        if self.stop or (self._deadline is not None and monotonic() > self._deadline):
            return None
        with self._lock:
            work = next(self._work, None)
            if work is None:
                self.exhausted = True
            return work
