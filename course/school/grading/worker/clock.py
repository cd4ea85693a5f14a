"""How long a worker is waited for: by the processor time that it has had, so that a busy machine costs nobody a point.

Up to its deadline nobody looks. Then a process that has had less of the processor than its time, and would go on if it
could, is waited for. One that sleeps is not: it would never end.
"""

from collections.abc import Callable
from time import monotonic

import psutil

from course.school.grading.worker.limits import tree

GRACE = 1.0
"""Seconds after a deadline for what is already under way: the grader may look late, where the machine is busy."""

BUSIEST = 20.0
"""Times as long as its time a process is waited for that gets too little of the processor."""

LOOK = 0.1
"""Seconds between two looks at a process that is late."""

ASLEEP = 10
"""Looks at which a process neither runs nor would: one that waits for nothing but a processor has none."""

FRESH = 0.05
"""Seconds for which what a process has used is not asked for again: most calls take less."""


class Used:
    """What a process and those that it has started have had of the processor since a call began.

    ``pid``: of the process; None for none, which has had all time that has gone by
    """

    def __init__(self, pid: int | None = None) -> None:
        self.nobody = pid is None
        self._processes = [] if pid is None else tree(pid)
        self._begun, self._before = monotonic(), self._total()

    def mark(self) -> None:
        """A call begins."""
        now = monotonic()
        if now - self._begun > FRESH:
            self._begun, self._before = now, self._total()

    @property
    def begun(self) -> float:
        """``time.monotonic()`` at which the call began, to a twentieth of a second."""
        return self._begun

    @property
    def seconds(self) -> float:
        """Of processor time since then."""
        return monotonic() - self._begun if self.nobody else self._total() - self._before

    @property
    def awake(self) -> bool:
        """Whether one of them runs, or would run if it could."""
        return any(map(_is_awake, self._processes))

    def _total(self) -> float:
        return sum(map(_processor_time, self._processes))


class Clock:
    """Whether one wait for a process is over.

    Parameters
    ----------
    deadline : ``time.monotonic()`` up to which it is waited for in any case
    used : what it has had of the processor
    usual : makes the seconds of processor time that it may have at least; asked once, when it is late
    """

    def __init__(self, deadline: float, used: Used, usual: Callable[[], float]) -> None:
        self._deadline, self._used, self._usual = deadline, used, usual
        self._seconds: float | None = None
        self._asleep = 0
        self._over: float | None = None

    def left(self) -> float:
        """Seconds to wait for the pipe before the next look."""
        return max(self._deadline - monotonic(), 0.0)

    def over(self) -> bool:
        """True if it has had its time; else there is more, and ``left`` says how much."""
        now = monotonic()
        if now <= self._deadline:
            return False
        if self._seconds is None:
            self._seconds = max(self._deadline - self._used.begun, self._usual())
        rest = self._seconds - self._used.seconds
        self._asleep += not self._used.awake
        if rest <= 0 or self._asleep >= ASLEEP or now > self._used.begun + BUSIEST * self._seconds:
            return True
        self._deadline = now + LOOK
        return False

    def long_over(self) -> bool:
        """True if what is there came too late: what trickles in is always there, so time is looked at after every turn.

        Counted from the first look, which may come late by no fault of the student's.
        """
        if not self.over():
            return False
        self._over = self._over or monotonic() + GRACE
        return monotonic() > self._over


def _is_awake(process: psutil.Process) -> bool:
    try:
        return process.status() in (psutil.STATUS_RUNNING, psutil.STATUS_DISK_SLEEP)
    except psutil.Error:
        return False


def _processor_time(process: psutil.Process) -> float:
    try:
        times = process.cpu_times()
    except psutil.Error:
        return 0.0
    return float(times.user + times.system)
