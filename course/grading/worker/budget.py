"""What all workers of one submission may use together: memory, and seconds where somebody limits them."""

from __future__ import annotations

import threading
from collections.abc import Callable
from time import monotonic, sleep

import psutil

from course.grading.errors import StudentError
from course.grading.worker.limits import Limits
from course.grading.worker.patience import NOT_RUN

LOOK = 0.1
"""Seconds between two looks at how much memory is used."""

COUNT = 10
"""Looks between two at which processes there are: that takes a look at all processes of the machine."""


class Budget:
    """The memory of all workers of a submission, and the end of its time.

    Nothing that a worker says is believed: what its processes hold is asked of the system, in a thread that runs while
    there are any.

    Parameters
    ----------
    limits : ``memory`` is what all may hold together, ``submission_seconds`` counts from now
    """

    def __init__(self, limits: Limits) -> None:
        self._memory, self._seconds = limits.memory, limits.submission_seconds
        self._until = None if self._seconds is None else monotonic() + self._seconds
        self._watched: dict[int, tuple[Callable[[str], None], list[psutil.Process]]] = {}
        self._thread: threading.Thread | None = None
        self._lock = threading.Lock()

    def at_most(self, seconds: float) -> float:
        """So many seconds, or those that are left of the submission's.

        Raises
        ------
        StudentError
            "timeout": none are left.
        """
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

        Parameters
        ----------
        end : is told why, and ends it
        """
        with self._lock:
            self._watched[pid] = end, []
            if self._thread is None:
                self._thread = threading.Thread(target=self._look_after, daemon=True)
                self._thread.start()

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
            for pid, (_, tree) in watched:
                if looks % COUNT == 0 or not tree:
                    tree[:] = _tree(pid)
            held = {pid: sum(map(_resident, tree)) for pid, (_, tree) in watched}
            if sum(held.values()) > self._memory:
                worst = max(held, key=held.__getitem__)
                self._watched.get(worst, watched[0][1])[0](
                    f"all workers of the submission together held more than {self._memory >> 20} MB"
                )
            looks += 1
            sleep(LOOK)


def _tree(pid: int) -> list[psutil.Process]:
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
