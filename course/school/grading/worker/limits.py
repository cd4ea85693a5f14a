"""Limits of a worker, and of all workers of a submission together: memory, and time that is waited for in vain.

Only the time of calls that never end is counted against a module. A submission that is slow and right uses none of it,
however long its checks take, so a machine that is busy costs nobody anything.
"""

import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from time import monotonic, sleep

import psutil

from course.school.grading.errors import StudentError

ALTOGETHER = 1.5
"""What the calls of one module that never end may take together, in calls' longest times."""

NEW, KNOWN = 0.25, 0.75
"""Shares of what is left that one call may take: of a function that hasn't answered yet, and of one that has. The
first calls are small ones, and what never ends mostly never ends at the first; so most hangs are found for little,
and what is left is for functions that have shown that they do end."""

LEAST = 0.05
"""Of a call's longest time: every call is given as much, and where less is left none is made, for right functions
might run out of it too."""

NOT_RUN = "not run for want of time"

LOOK = 0.1
"""Seconds between two looks at how much memory is used."""

COUNT = 10
"""Looks between two at which processes there are: that takes a look at all processes of the machine."""


@dataclass(frozen=True)
class Limits:
    """Memory and time that a worker, and all workers of a submission together, may use.

    Attributes
    ----------
    call_seconds : processor time of importing the file, and of one call, if a loop in plain Python would not take
        longer; ``TimeBudget`` says when it is less
    cpu_seconds : processor time of one worker process
    memory : bytes: the address space of each process, and what all workers of a submission may hold together
    deaths : processes that the calls of one function may end before it isn't called again
    submission_seconds : wall clock of all checks of a submission, after which no function is called; None for no limit
    """

    call_seconds: float = 10.0
    cpu_seconds: int = 600
    memory: int = 2 << 30
    deaths: int = 4
    submission_seconds: float | None = None


class TimeBudget:
    """The time that is left for calls that never end; one for all workers of a module.

    Parameters
    ----------
    call_seconds : the longest time of one call
    small_first : whether the first calls of a function are small ones, as they are where all checks are run
    """

    def __init__(self, call_seconds: float, small_first: bool = True) -> None:
        self._longest = call_seconds
        self._new = NEW if small_first else KNOWN
        self._lost = 0.0

    def limit(self, answered: bool) -> float:
        """How long the next call may take [s].

        Raises StudentError: "timeout": no time is left.
        ``answered``: whether the function has given a value before
        """
        left, least = ALTOGETHER * self._longest - self._lost, LEAST * self._longest
        if left < least:
            raise StudentError(
                "timeout",
                f"{NOT_RUN}: calls of this module that don't end have taken {self._lost:.1f} s",
            )
        share = left * (KNOWN if answered else self._new)
        return min(self._longest, max(share, least))

    def lose(self, seconds: float) -> None:
        """A call has taken so long and not ended."""
        self._lost += seconds

    def __str__(self) -> str:
        """Why a limit is shorter than usual; empty if it isn't."""
        return (
            f" (less than usual: calls before have taken {self._lost:.1f} s and not ended)"
            if self._lost
            else ""
        )


class WorkerBudget:
    """The memory of all workers of a submission, and the end of its time.

    Nothing that a worker says is believed: what its processes hold is asked of the system, in a thread that runs while
    there are any.
    ``limits``: ``memory`` is what all may hold together, ``submission_seconds`` counts from now
    """

    def __init__(self, limits: Limits) -> None:
        self._memory, self._seconds = limits.memory, limits.submission_seconds
        self._until = None if self._seconds is None else monotonic() + self._seconds
        self._watched: dict[int, tuple[Callable[[str], None], list[psutil.Process]]] = {}
        self._thread: threading.Thread | None = None
        self._lock = threading.Lock()

    def at_most(self, seconds: float) -> float:
        """So many seconds, or those that are left of the submission's; ``StudentError`` "timeout" if none are."""
        if self._until is None:
            return seconds
        left = self._until - monotonic()
        if left <= 0:
            raise StudentError("timeout", f"{NOT_RUN}: {self.over}")
        return min(seconds, left)

    @property
    def over(self) -> str:
        """That the submission's time is over; empty while it isn't."""
        if self._until is None or monotonic() < self._until:
            return ""
        return f"the submission's {self._seconds:g} s are over"

    def watch(self, pid: int, end: Callable[[str], None]) -> None:
        """Count what a process and its children hold.

        ``end``: is told why, and ends it
        """
        with self._lock:
            self._watched[pid] = end, []
            if self._thread is None:
                thread = threading.Thread(target=self._look_after, daemon=True)
                thread.start()
                # After it has begun: Ctrl-C may come before, and the next one begins anew.
                self._thread = thread

    def forget(self, pid: int) -> None:
        """It has ended."""
        with self._lock:
            self._watched.pop(pid, None)

    def _look_after(self) -> None:
        looks = 0
        while True:
            with self._lock:
                watched = [*self._watched.items()]
                if not watched:
                    self._thread = None
                    return
            for pid, (_, members) in watched:
                if looks % COUNT == 0 or not members:
                    members[:] = tree(pid)
            held = {pid: sum(map(_resident, members)) for pid, (_, members) in watched}
            if sum(held.values()) > self._memory:
                worst = max(held, key=held.__getitem__)
                self._watched.get(worst, watched[0][1])[0](
                    f"all workers of the submission together held more than {self._memory >> 20} MB"
                )
            looks += 1
            sleep(LOOK)


def end_tree(pid: int) -> None:
    """Kill a process and all that it has started, in whatever group or session; nothing if it has ended."""
    for process in tree(pid):
        with suppress(psutil.Error):
            process.kill()


def tree(pid: int) -> list[psutil.Process]:
    """A process and all that it has started; empty if it has ended."""
    try:
        process = psutil.Process(pid)
        return [process, *process.children(recursive=True)]
    except psutil.Error:
        return []


def _resident(process: psutil.Process) -> int:
    try:
        return int(process.memory_info().rss)
    except psutil.Error:
        return 0
