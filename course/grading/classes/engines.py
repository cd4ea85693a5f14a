"""Work on many items: in processes of this machine, on a dask cluster, and apart from the grader, within limits.

When a process of a pool dies the pool can't say at which item, so as many items as there are processes are under way
and no more, and those are then done once again each alone. The item whose process dies once more is the one; all others
get their results. A worker of a cluster that is lost costs nothing but time: the scheduler hands its work to another
one, until as many have been lost with the same item as its setting ``distributed.scheduler.allowed-failures`` says, 3
if nothing else is set.
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
from dataclasses import dataclass
from functools import cache
from multiprocessing.connection import wait as wait_for
from queue import SimpleQueue
from time import monotonic, sleep
from typing import Any, Generic, TypeVar

import psutil

Item = TypeVar("Item")
Shared = TypeVar("Shared")
Value = TypeVar("Value")

GRACE = 3.0
"""Seconds that processes have to end in when they are told to."""

DIED = "the process that graded it has died twice"

SECONDS = 5.0
"""Wall clock that one item may take apart from the grader."""

LARGEST_SPACE = 1_000_000_000
"""Bytes of address space that a process apart may take besides what it has when it begins."""


@dataclass(frozen=True)
class Outcome(Generic[Item, Value]):
    """How the work on one item ended.

    Attributes
    ----------
    item : the work
    value : what came of it; None after a fault
    fault : what went wrong in the grader itself; empty if nothing did
    """

    item: Item
    value: Value | None
    fault: str = ""


Engine = Callable[
    [Callable[[Item, Shared], Value], Sequence[Item], Shared],
    Generator[Outcome[Item, Value], None, None],
]
"""(function, items, what all items share) -> an outcome for each item, in whatever order they end.

The function takes an item and what is shared. Closing the iterator ends all work.
"""


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
                    yield Outcome(item, None, _told(error))
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
    """The processes that still run after that many seconds at most.

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


def apart(
    function: Callable[[Item], Value],
    items: Sequence[Item],
    jobs: int = 1,
    seconds: float = SECONDS,
) -> dict[int, Value | None]:
    """A function's values for items of students' text: by the item's place, None where it came to no end.

    A parser can be made to take long, or to die. A process that takes more time or memory than it may is ended, and
    costs its own item only. Nothing of the text is run.

    Parameters
    ----------
    function : one that can be imported
    jobs : processes
    seconds : that one item may take
    """
    with closing(in_processes(_limited, [*enumerate(items)], (function, seconds), jobs)) as ended:
        return {outcome.item[0]: outcome.value for outcome in ended}


def _limited(numbered: tuple[int, Item], how: tuple[Callable[[Item], Value], float]) -> Value:
    """Call the function for an item, within the limits."""
    (_, item), (function, seconds) = numbered, how
    _limit_memory()
    if not hasattr(signal, "setitimer"):
        return function(item)
    # The parser doesn't come back to Python until it is done, so no exception could end it: the signal kills.
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        return function(item)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)


@cache
def _limit_memory() -> None:
    """Limit this process, once."""
    try:
        import resource

        hard = resource.getrlimit(resource.RLIMIT_AS)[1]
        # NumPy's threads take space by the number of cores.
        limit = psutil.Process().memory_info().vms + LARGEST_SPACE
        limit = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
        resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
    except (ImportError, OSError, ValueError, psutil.Error):
        return  # a system without such limits: time and the size of what is read are bounded still


def on_cluster(
    function: Callable[[Item, Shared], Value], items: Sequence[Item], shared: Shared, address: str
) -> Generator[Outcome[Item, Value], None, None]:
    """Call a function for each item on the workers of a dask cluster, which need the course installed.

    Parameters
    ----------
    function : one that can be imported
    shared : its second argument, which each worker gets once
    address : of the scheduler, such as tcp://127.0.0.1:8786

    Yields
    ------
    Outcome
        One for each item, as they end. Close the generator to cancel what is left.

    Raises
    ------
    CourseError
        ``distributed`` isn't installed, no scheduler answers, it has no workers, or it or all of them have gone.
    """
    from course.cluster.connection import Connection, arrived

    cluster = Connection(address)
    ended: SimpleQueue[Any] = SimpleQueue()
    pending: dict[str, tuple[Any, Item]] = {}
    try:
        # A task, not scattered data: that would be lost with the workers that hold it.
        everywhere = cluster.client.submit(_same, shared, pure=False)
        for item in items:
            # Not pure: answers that an earlier run left on the cluster are not for this one.
            future = cluster.client.submit(function, item, everywhere, pure=False, retries=1)
            pending[future.key] = future, item
            future.add_done_callback(ended.put)
        while pending:
            cluster.look()
            for ready in arrived(ended):
                future, item = pending.pop(ready.key)
                yield _outcome(cluster, item, future)
    finally:
        cluster.cancel([future for future, _ in pending.values()])
        cluster.close()


def _outcome(cluster: Any, item: Item, future: Any) -> Outcome[Item, Any]:
    if future.cancelled():
        # If the scheduler has gone, that is to be told.
        cluster.look()
        return Outcome(item, None, f"the cluster gave it up ({future.status})")
    try:
        (value,) = cluster.gather([future])
    except Exception as error:
        if future.status != "error":
            raise
        return Outcome(item, None, _told(error))
    return Outcome(item, value)


def _same(value: Value) -> Value:
    return value


def _told(error: BaseException) -> str:
    """An exception in a line."""
    return f"{type(error).__name__}: {error}".removesuffix(": ")
