"""Checks of one's functions in the background, by a process that can be ended at any time."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from course.base.processes import environment_apart
from course.school.grading.worker.limits import end_tree

NICE = 10
"""Added to its niceness where pictures come first."""


class Checker:
    """Checks modules one after the other.

    Parameters
    ----------
    folder : of the functions
    event : called by a thread of its own with each line that ``course.school.studio.checking`` says, and {"done":
        True}; each with the number of the ``run`` that it belongs to

    Attributes
    ----------
    run : number of the present one; what is told of earlier ones is out of date
    """

    def __init__(self, folder: Path, event: Callable[[dict[str, Any]], None]) -> None:
        self._folder, self._event = folder, event
        self._process: subprocess.Popen[str] | None = None
        self._spare: subprocess.Popen[str] | None = None
        self.run = 0

    def prepare(self) -> None:
        """Have a process ready for the next checks: what it imports takes as long as many a check."""
        if self._spare is None or self._spare.poll() is not None:
            self._spare = subprocess.Popen(
                [sys.executable, "-m", "course.school.studio.checking", str(self._folder)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
                encoding="utf-8",
                env=environment_apart(),
                process_group=0 if os.name == "posix" else None,
            )

    def check(self, modules: Sequence[str], first: Sequence[str], nice: bool) -> None:
        """Check these modules, their functions among ``first`` before others; ends what is being checked.

        ``nice`` : whether pictures come before these checks
        """
        self._end()
        self.prepare()
        process, self._process, self._spare = self._spare, self._spare, None
        assert process is not None
        assert process.stdin is not None
        if nice and os.name == "posix":
            with contextlib.suppress(OSError):
                os.setpriority(os.PRIO_PROCESS, process.pid, NICE)
        with contextlib.suppress(OSError):
            process.stdin.write(json.dumps({"modules": [*modules], "first": [*first]}) + "\n")
            process.stdin.close()
        arguments = process, self.run
        threading.Thread(target=self._listen, args=arguments, daemon=True).start()
        if nice:
            # A save ends these checks, and wants others at once.
            self.prepare()

    def stop(self) -> None:
        """End what is being checked, with the workers that it has started."""
        self._end()
        self.prepare()

    def close(self) -> None:
        """End everything."""
        self._end()
        spare, self._spare = self._spare, None
        if spare is not None:
            # It ends by itself: nobody asks.
            spare.communicate()

    def _end(self) -> None:
        process, self._process = self._process, None
        self.run += 1
        if process is not None:
            end_tree(process.pid)
            process.wait()

    def _listen(self, process: subprocess.Popen[str], run: int) -> None:
        assert process.stdout is not None
        with process.stdout as lines:
            for line in lines:
                with contextlib.suppress(ValueError):
                    self._event(json.loads(line) | {"run": run})
        self._event({"done": True, "run": run})
