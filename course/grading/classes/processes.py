"""Work in a pool of processes that outlives the death of one of them.

When a process dies the pool can't say at which item, so as many items as there are processes are under way and no
more, and those are then done once again each alone. The item whose process dies once more is the one; all others get
their results.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections import deque
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing
from multiprocessing.connection import wait as wait_for
from time import monotonic, sleep
from typing import TypeVar

from course.grading.classes.outcome import Outcome, told

Item = TypeVar("Item")
Shared = TypeVar("Shared")
Value = TypeVar("Value")

GRACE = 3.0
"""Seconds that processes have to end in when they are told to."""

DIED = "the process that graded it has died twice"


def in_processes(
    function: Callable[[Item, Shared], Value], items: Sequence[Item], shared: Shared, jobs: int
) -> Generator[Outcome[Item, Value], None, None]:
    """Call a function for each item in a pool of processes.

    Parameters
    ----------
    function : one that can be imported
    shared : its second argument
    jobs : processes

    Yields
    ------
    Outcome
        One for each item, as they end. Close the generator to end all work at once.
    """
    waiting = deque(items)
    suspects: deque[Item] = deque()
    while waiting or suspects:
        # A suspect has the pool for itself.
        work, size = (deque([suspects.popleft()]), 1) if suspects else (waiting, jobs)
        alone = size == 1 and work is not waiting
        with closing(_until_broken(function, work, shared, size)) as outcomes:
            for outcome in outcomes:
                if not isinstance(outcome, list):
                    yield outcome
                elif alone:
                    yield from (Outcome(item, None, DIED) for item in outcome)
                else:
                    suspects.extend(outcome)


def _until_broken(
    function: Callable[[Item, Shared], Value], work: deque[Item], shared: Shared, size: int
) -> Generator[Outcome[Item, Value] | list[Item], None, None]:
    """Outcomes until all work is done or the pool breaks; then a list of the items that were under way."""
    before = set(multiprocessing.active_children())
    pool = ProcessPoolExecutor(min(size, len(work)), multiprocessing.get_context("spawn"), _start)
    running: dict[Future[Value], Item] = {}
    try:
        while work or running:
            while work and len(running) < size:
                item = work.popleft()
                running[_submitted(pool, function, item, shared)] = item
            done, _ = wait(running, timeout=1.0, return_when=FIRST_COMPLETED)
            broken = False
            for future in done:
                error = future.exception()
                if isinstance(error, BrokenProcessPool):
                    broken = True
                    continue
                item = running.pop(future)
                if error is not None:
                    yield Outcome(item, None, told(error))
                else:
                    yield Outcome(item, future.result())
            if broken:
                # Those that had ended before the pool broke have their results.
                wait(running)
                for future, item in [*running.items()]:
                    if future.exception() is None:
                        del running[future]
                        yield Outcome(item, future.result())
                lost, running = [*running.values()], {}
                yield lost
                return
        pool.shutdown()
    finally:
        _end(pool, set(multiprocessing.active_children()) - before)


def _submitted(
    pool: ProcessPoolExecutor, function: Callable[[Item, Shared], Value], item: Item, shared: Shared
) -> Future[Value]:
    try:
        return pool.submit(_call, function, item, shared)
    except BrokenProcessPool as error:
        # A process died with nothing to do, or in starting; that is told like any other death.
        lost: Future[Value] = Future()
        lost.set_exception(error)
        return lost


def _end(pool: ProcessPoolExecutor, processes: set[multiprocessing.process.BaseProcess]) -> None:
    """End the processes of a pool, busy or not."""
    for process in processes:
        process.terminate()
    for process in _left(processes, GRACE):
        process.kill()
    _left(processes, GRACE)
    pool.shutdown(wait=False, cancel_futures=True)


def _left(
    processes: set[multiprocessing.process.BaseProcess], seconds: float
) -> set[multiprocessing.process.BaseProcess]:
    """Those that still run after that many seconds at most.

    They are not joined: the pool's own thread joins them too, and one whose end that thread was told of looks alive
    to any other until that thread has noted it.
    """
    deadline = monotonic() + seconds
    while (left := processes & {*multiprocessing.active_children()}) and monotonic() < deadline:
        sleep(0.01)
    return left


def _call(function: Callable[[Item, Shared], Value], item: Item, shared: Shared) -> Value:
    try:
        return function(item, shared)
    except SystemExit:
        # Told to end; the pool would take it for the item's error and go on.
        os._exit(1)


def _start() -> None:
    """Prepare a process: Ctrl-C is the parent's business, and none outlives the parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # By an exception, so that a student's process is ended on the way.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    threading.Thread(target=_follow_parent, daemon=True).start()


def _follow_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait_for([parent.sentinel])
        os._exit(1)
