"""A progress bar on stderr, where stderr is a terminal; elsewhere nothing is shown or imported."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

PATIENCE = 0.2
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
        yield bar.report
    finally:
        bar.close()


class _Bar:
    """A bar that appears once the work has lasted for PATIENCE."""

    def __init__(self, label: str) -> None:
        self._label = label
        self._since = time.perf_counter()
        self._shown: tuple[Progress, TaskID] | None = None

    def report(self, done: float, _available: bool) -> None:
        if self._shown is None and time.perf_counter() - self._since >= PATIENCE:
            self._shown = self._open()
        if self._shown is not None:
            progress, task = self._shown
            progress.update(task, completed=done)

    def close(self) -> None:
        if self._shown is not None:
            self._shown[0].stop()

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
            TextColumn("left"),
            TimeRemainingColumn(compact=True),
            console=Console(stderr=True),
            refresh_per_second=8,
        )
        progress.start()
        return progress, progress.add_task(self._label, total=1.0)
