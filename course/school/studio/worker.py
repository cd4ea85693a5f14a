"""The studio's end of a process that renders: commands in, messages out, and what becomes of it."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import IO, Any

from course.base.processes import environment_apart
from course.school.grading.worker.limits import Limits, WorkerBudget, end_tree
from course.school.studio.messages import Channel, messages

PROGRAM = "course.school.studio.program"

MOST_PRINTED = 1 << 26
"""Bytes that one process may print."""

SHOWN = 4000
"""Characters of them that are kept."""

MEMORY = 4 << 30
"""Bytes that one process may hold."""

Event = Callable[["RenderWorker", dict[str, Any], list[Any]], None]
"""Called by threads of the worker's own with what it tells; {"ended": why} comes last."""


class RenderWorker:
    """A process that renders.

    Parameters
    ----------
    event : see ``Event``
    nice : added to its niceness
    """

    def __init__(self, event: Event, nice: int = 0) -> None:
        self._event = event
        self._why = ""
        self.printed = ""
        self._process = subprocess.Popen(
            [sys.executable, "-m", PROGRAM],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env=environment_apart() | {"PYTHONUNBUFFERED": "1"},
            # Ctrl-C is for the studio, which ends its processes.
            process_group=0 if os.name == "posix" else None,
        )
        if nice and os.name == "posix":
            with contextlib.suppress(OSError):
                os.setpriority(os.PRIO_PROCESS, self._process.pid, nice)
        assert self._process.stdin is not None
        self._channel = Channel(self._process.stdin)
        self._budget = WorkerBudget(Limits(memory=MEMORY))
        self._budget.watch(self._process.pid, self.end)
        self._threads = [
            threading.Thread(target=work, daemon=True) for work in (self._listen, self._drain)
        ]
        for thread in self._threads:
            thread.start()

    def send(self, **command: Any) -> None:
        """Send a command; nothing happens if the process is gone, which is told as an event."""
        with contextlib.suppress(OSError, ValueError):
            self._channel.send(command)

    def end(self, why: str) -> None:
        """End it, and what a function has started; the first reason is told."""
        self._why = self._why or why
        end_tree(self._process.pid)
        with contextlib.suppress(OSError):
            if os.name == "posix" and self._process.returncode is None:
                os.killpg(self._process.pid, signal.SIGKILL)
            self._process.kill()

    def close(self) -> None:
        """End it, and wait for that."""
        self.end("closed")
        for thread in self._threads:
            thread.join()

    def _listen(self) -> None:
        pipe: IO[bytes] = self._process.stdout  # type: ignore[assignment]
        with pipe:
            for told, arrays in messages(pipe):
                self._event(self, told, arrays)
        self._budget.forget(self._process.pid)
        self.end("")
        code = self._process.wait()
        with contextlib.suppress(OSError):
            self._channel.close()
        why = self._why or _meaning(code)
        self._event(self, {"ended": why}, [])

    def _drain(self) -> None:
        printed = 0
        pipe: Any = self._process.stderr
        with pipe:
            while data := pipe.read1(1 << 16):
                printed += len(data)
                if printed > MOST_PRINTED:
                    # It is read on until it is gone.
                    self.end(f"it printed more than {MOST_PRINTED >> 20} MB")
                room = SHOWN - len(self.printed)
                if room > 0:
                    text = data.decode("utf-8", "replace")
                    self.printed += text[:room]
                    self._event(self, {"printed": self.printed}, [])


def _meaning(code: int) -> str:
    """What an exit code says."""
    if code < 0:
        names = {
            -4: "illegal instruction",
            -6: "abort",
            -8: "arithmetic error",
            -9: "killed",
            -11: "segmentation fault",
        }
        return f"its process ended: {names.get(code, f'signal {-code}')}"
    return f"its process ended with exit code {code}"
