"""A progress bar on stderr, where stderr is a terminal; elsewhere nothing is shown or imported."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import Lock, Timer
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

SHOWN_AFTER = 0.2
"""Seconds before a bar appears: rich takes 30 ms to import, and a flash tells nobody anything."""

Report = Callable[[float, bool], None]
"""Called with the share done, 0 to 1, and whether there is a picture so far."""


@contextmanager
def progress_bar(label: str) -> Iterator[Report | None]:
    """Show how far a render is.

    ``label``: what stands before the bar.
    Yields what `course.render` takes as `progress`; None where nobody looks.
    """
    if not sys.stderr.isatty():
        yield None
        return
    bar = _Bar(label)
    try:
        yield bar
    finally:
        bar.close()


class _Bar:
    """A bar that appears once the work has lasted for SHOWN_AFTER; it only pulses until a share is reported."""

    def __init__(self, label: str) -> None:
        self._label = label
        self._done: float | None = None
        self._shown: tuple[Progress, TaskID] | None = None
        self._closed = False
        self._lock = Lock()
        # In a thread of its own, since a scene may be read for many seconds without a report.
        self._timer = Timer(SHOWN_AFTER, self._show)
        self._timer.daemon = True
        self._timer.start()

    def __call__(self, done: float, _available: bool) -> None:
        with self._lock:
            self._done = done
            if self._shown is not None:
                progress, task = self._shown
                progress.update(task, completed=done, total=1.0)

    def note(self, text: str) -> None:
        """Say something next to the label."""
        with self._lock:
            self._label += f" ({text})"
            if self._shown is not None:
                progress, task = self._shown
                progress.update(task, description=self._label)

    def close(self) -> None:
        self._timer.cancel()
        with self._lock:
            self._closed = True
            if self._shown is not None:
                self._shown[0].stop()

    def _show(self) -> None:
        with self._lock:
            if not self._closed:
                self._shown = self._open()

    def _open(self) -> tuple[Progress, TaskID]:
        from rich.console import Console
        from rich.progress import (
            BarColumn,
            Progress,
            TaskProgressColumn,
            TextColumn,
            TimeElapsedColumn,
            TimeRemainingColumn,
        )

        progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(bar_width=None),
            TaskProgressColumn(),
            TimeElapsedColumn(),
            TextColumn("gone,"),
            TimeRemainingColumn(compact=True),
            TextColumn("left"),
            console=Console(stderr=True),
            refresh_per_second=8,
        )
        progress.start()
        task = progress.add_task(self._label, total=None)
        if self._done is not None:
            progress.update(task, completed=self._done, total=1.0)
        return progress, task
