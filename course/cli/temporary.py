"""A temporary folder for a command, which goes however the process ends, short of being killed."""

from __future__ import annotations

import os
import shutil
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from course.errors import Ended

ENDS = ("SIGTERM", "SIGHUP")
"""Signals that end a process, and have no exception as Ctrl-C has; not every system has both."""

GRACE = 5.0
"""Seconds in which a process that was told to end should have ended."""


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """A new folder, deleted at the end of the block, or when the process is told to end or its terminal is closed.

    The process then ends by SystemExit, with the status that shells give it. Foreign code may drop an exception that
    comes out of a signal's handler (importlib does so in callbacks, msgspec when it looks up types), so what has not
    ended after GRACE seconds, or is told again, ends at once, with the same status.
    """
    end = _End()
    with end.awaited(), TemporaryDirectory(prefix="course-") as folder:
        end.folder = folder
        yield Path(folder)


class _End:
    """What becomes of a signal to end.

    ``folder``: to be deleted before.
    """

    def __init__(self) -> None:
        self.folder: str | None = None
        self._status: int | None = None

    @contextmanager
    def awaited(self) -> Iterator[None]:
        """Listen to the signals, as far as this system has them."""
        known = [getattr(signal, name) for name in ENDS if hasattr(signal, name)]
        # What is ignored, as under nohup, stays so.
        taken = [number for number in known if signal.getsignal(number) is signal.SIG_DFL]
        for number in taken:
            signal.signal(number, self._tell)
        try:
            yield
        finally:
            for number in taken:
                signal.signal(number, signal.SIG_DFL)
            if self._status is not None and hasattr(signal, "setitimer"):
                signal.setitimer(signal.ITIMER_REAL, 0.0)
                signal.signal(signal.SIGALRM, signal.SIG_DFL)

    def _tell(self, number: int, _frame: object) -> None:
        if self._status is not None:
            self._force(number, None)
        # As shells say it of a process that a signal has ended.
        self._status = 128 + number
        # A timer of the system, for a thread can't be started in the midst of starting another.
        if hasattr(signal, "setitimer"):
            signal.signal(signal.SIGALRM, self._force)
            signal.setitimer(signal.ITIMER_REAL, GRACE)
        raise Ended(self._status)

    def _force(self, _number: int, _frame: object) -> None:
        assert self._status is not None
        if self.folder is not None:
            shutil.rmtree(self.folder, ignore_errors=True)
        os._exit(self._status)
