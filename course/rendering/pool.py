"""Threads over tiles. Embree and NumPy's loops run without the interpreter lock, so threads are enough."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable
from time import monotonic
from typing import Any, Protocol

from course.core.types import Floats32
from course.rendering.passes import Work
from course.transport.counters import Counters
from course.transport.tracing import CancelledError, Tracer

TICK = 0.05
"""Seconds between two looks of the main thread at progress and Ctrl-C."""


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


class Pool:
    """Runs work on threads until it is done, the time is up, or somebody presses Ctrl-C.

    Attributes
    ----------
    counters : of all threads, after each run
    interrupted : Ctrl-C was pressed
    threads : that render
    """

    def __init__(self, tracer: Tracer, film: Sink, threads: int) -> None:
        self._tracer = tracer
        self._film = film
        self.threads = threads
        self.counters = Counters()
        self.interrupted = False

    def prepare(self, began: float) -> float:
        """When a time limit begins to count [``time.monotonic()``]: with the render, for threads have the scene."""
        return began

    def run(
        self,
        work: Iterable[Work],
        deadline: float | None,
        tick: Callable[[int, int], None] | None,
    ) -> bool:
        """Do the work in order; whether all of it was done.

        Parameters
        ----------
        deadline : ``time.monotonic()`` after which no tile is begun
        tick : called now and then from this thread with the number of tiles done so far, and how many of
            them in the first pass
        """
        run = _Run(self._tracer, self._film, work, deadline)
        threads = [
            threading.Thread(target=run.worker, name=f"tiles-{number}", daemon=True)
            for number in range(self.threads)
        ]
        for thread in threads:
            thread.start()
        try:
            while not run.finished.wait(TICK) and any(thread.is_alive() for thread in threads):
                if tick is not None:
                    tick(run.done, run.done_first)
        except KeyboardInterrupt:
            self.interrupted = True
        finally:
            run.stop = True
            for thread in threads:
                thread.join()
        if run.error is not None:
            raise run.error
        if tick is not None and not self.interrupted:
            tick(run.done, run.done_first)
        self.counters.add(run.counters)
        return run.exhausted and not self.interrupted

    def close(self) -> None:
        """Nothing: each run ends its threads."""


class _Run:
    """The state that the threads of one run share, under one lock."""

    def __init__(
        self, tracer: Tracer, film: Sink, work: Iterable[Work], deadline: float | None
    ) -> None:
        self._tracer = tracer
        self._film = film
        self._work = iter(work)
        self._deadline = deadline
        self._lock = threading.Lock()
        self._working = 0
        self._next_order: dict[int, int] = {}
        self._early: dict[tuple[int, int], tuple[Work, Floats32, Floats32 | float]] = {}
        self._adding: set[int] = set()
        self.counters = Counters()
        self.finished = threading.Event()
        self.exhausted = False
        self.stop = False
        self.done = 0
        self.done_first = 0
        self.error: BaseException | None = None

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
                self._add(work, pixels, weight)
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

    def _add(self, work: Work, pixels: Floats32, weight: Floats32 | float) -> None:
        """Into the film, the passes of a tile in their order even if a later one is finished first."""
        tile = work.tile.number
        with self._lock:
            self._early[tile, work.order] = (work, pixels, weight)
            # Somebody who is adding to this tile now will see this pass when done with the one before.
            if tile in self._adding:
                return
            self._adding.add(tile)
            order = self._next_order.get(tile, 0)
        while True:
            with self._lock:
                ready = self._early.pop((tile, order), None)
                if ready is None:
                    self._next_order[tile] = order
                    self._adding.discard(tile)
                    return
            item, pixels, weight = ready
            self._film.add(item.tile, pixels, weight, item.first + item.samples, item.whole)
            order += 1
            with self._lock:
                self.done += 1
                self.done_first += item.order == 0
