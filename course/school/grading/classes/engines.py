"""Work on many items: in processes of this machine, on a dask cluster, and apart from the grader, within limits.

A process that dies takes its item with it and no other: that one is done once again, alone, when all others have ended.
The item whose process dies once more is at fault. A worker of a cluster that is lost costs nothing but time: the
scheduler hands its work to another one, until as many have been lost with the same item as its setting
``distributed.scheduler.allowed-failures`` says, 3 if nothing else is set.
"""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, suppress
from dataclasses import dataclass
from functools import cache
from multiprocessing import get_context
from multiprocessing.connection import wait as wait_for
from multiprocessing.process import BaseProcess
from queue import SimpleQueue
from time import monotonic, sleep
from typing import Any, Generic, TypeVar

import psutil

Item = TypeVar("Item")
Shared = TypeVar("Shared")
Value = TypeVar("Value")

GRACE = 3.0
"""Seconds that processes have to end in when they are told to."""

DIED = "the process that graded it has died twice, or was ended, for it took too long or too much memory"

MOST_MEMORY = 1_400_000_000
"""Bytes that a process may hold; to grade all modules takes 500 MB."""

LOOK = 0.1
"""Seconds between two looks at that."""

OWN_SECONDS = 600
"""Processor time that a process may take for one item, its children's not counted: to grade all modules takes the
grader 22 s besides what students' functions take."""

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
    """Call a function for each item in processes.

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
    suspects: list[Item] = []
    with closing(_each(function, items, shared, jobs)) as outcomes:
        for outcome in outcomes:
            if outcome.fault == DIED:
                suspects.append(outcome.item)
            else:
                yield outcome
    with closing(_each(function, suspects, shared, 1)) as outcomes:
        yield from outcomes


def _each(
    function: Callable[[Item, Shared], Value], items: Sequence[Item], shared: Shared, jobs: int
) -> Generator[Outcome[Item, Value], None, None]:
    """Outcomes as they end; each of as many threads has a process, so it is known whose item a process was at."""
    before = set(multiprocessing.active_children())
    pools: dict[int, ProcessPoolExecutor] = {}
    shares: dict[int, set[int]] = {}
    processes = max(1, min(jobs, len(items)))
    starting, closed = threading.Lock(), threading.Event()

    def outcome(item: Item) -> Outcome[Item, Value]:
        thread = threading.get_ident()
        try:
            with starting:
                if closed.is_set():
                    return Outcome(item, None, DIED)
                if thread not in pools:
                    share = shares.setdefault(thread, _share(len(shares), processes))
                    pools[thread] = ProcessPoolExecutor(1, get_context("spawn"), _start, (share,))
                work = pools[thread].submit(_call, function, item, shared, OWN_SECONDS)
            return Outcome(item, work.result())
        except BrokenProcessPool:
            del pools[thread]
            return Outcome(item, None, DIED)
        except Exception as error:  # noqa: BLE001 - of the work on this item, and of no other
            return Outcome(item, None, _told(error))

    threads = ThreadPoolExecutor(processes)
    try:
        for future in as_completed([threads.submit(outcome, item) for item in items]):
            yield future.result()
    finally:
        with starting:
            closed.set()
        threads.shutdown(wait=False, cancel_futures=True)
        _end(set(multiprocessing.active_children()) - before)
        threads.shutdown()


def _end(processes: set[BaseProcess]) -> None:
    """End processes, busy or not."""
    for process in processes:
        process.terminate()
    for process in _left(processes, GRACE):
        process.kill()
    _left(processes, GRACE)


def _left(processes: set[BaseProcess], seconds: float) -> set[BaseProcess]:
    """The processes that still run after that many seconds at most.

    They are not joined: the pool's own thread joins them too, and one whose end that thread was told of looks alive
    to any other until that thread has noted it.
    """
    deadline = monotonic() + seconds
    while (left := processes & {*multiprocessing.active_children()}) and monotonic() < deadline:
        sleep(0.01)
    return left


_WORKING = threading.Event()
"""Whether this process is at an item."""


def _call(
    function: Callable[[Item, Shared], Value], item: Item, shared: Shared, own_seconds: float
) -> Value:
    try:
        _WORKING.set()
        _limit_own_time(own_seconds)
        return function(item, shared)
    except SystemExit:
        # Told to end; the pool would take it for the item's error and go on.
        os._exit(1)
    finally:
        _limit_own_time(0)
        _WORKING.clear()


def _limit_own_time(seconds: float) -> None:
    """End this process after so much processor time of its own, whatever it is at; 0 for no end."""
    if hasattr(signal, "setitimer"):
        # Not an exception: a value of a student's that nobody has thought of may keep the grader in compiled code.
        signal.signal(signal.SIGPROF, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_PROF, seconds)


def _share(number: int, processes: int) -> set[int]:
    """The processors for one of so many processes, and for all that it starts; empty for all there are.

    Many threads of one submission would else take the time of others.
    """
    if processes == 1 or not hasattr(os, "sched_getaffinity"):
        return set()
    there = sorted(os.sched_getaffinity(0))
    return {*there[number::processes]} or {there[number % len(there)]}


def _start(processors: set[int]) -> None:
    """Prepare a process: Ctrl-C is the parent's business, and none outlives the parent."""
    if processors:
        # A system may refuse it: then whatever one takes the others lack.
        with suppress(OSError):
            os.sched_setaffinity(0, processors)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _terminated)
    threading.Thread(target=_follow_parent, daemon=True).start()
    threading.Thread(target=_stay_small, daemon=True).start()


def _terminated(*_: object) -> None:
    """End this process: by an exception, which ends a student's process on the way, or at once if there is none.

    The pool takes an exception that comes while it sends a value for the value's error, and waits for more work.
    """
    if _WORKING.is_set():
        sys.exit(1)
    os._exit(1)


def _follow_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait_for([parent.sentinel])
        os._exit(1)


def _stay_small() -> None:
    """End this process where it holds too much: its item has been too much for it, and is told as that."""
    process = psutil.Process()
    while process.memory_info().rss < MOST_MEMORY:
        sleep(LOOK)
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

    Raises CourseError: ``distributed`` isn't installed, no scheduler answers, it has no workers, or it or all of them
    have gone.

    Parameters
    ----------
    function : one that can be imported
    shared : its second argument, which each worker gets once
    address : of the scheduler, such as tcp://127.0.0.1:8786

    Yields
    ------
    Outcome
        One for each item, as they end. Close the generator to cancel what is left.
    """
    from course.engine.render.cluster.connection import Connection, arrived

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
