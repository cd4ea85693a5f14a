"""A progress bar: on stderr where that is a terminal, below the cell in a notebook; else nothing is shown or imported.

In a notebook it is one output that changes and is empty in the end. A widget would be saved as a blank, and lines that
overwrite each other would be saved one below the other.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import ContextVar
from threading import Lock, Timer
from time import monotonic
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

SHOWN_AFTER = 0.2
"""Seconds before a bar appears: rich takes 30 ms to import, and a flash tells nobody anything."""

LONG = 1.0
"""Seconds before one appears in a notebook, where it is a part of what is kept."""

REDRAWN = 0.2
"""Seconds between two changes of it."""

Report = Callable[[float, bool], None]
"""Called with the share done, 0 to 1, and whether there is a picture so far."""


_QUIET: ContextVar[bool] = ContextVar("quiet", default=False)


@contextmanager
def quiet() -> Iterator[None]:
    """Show no bar but where one is asked for."""
    before = _QUIET.set(True)
    try:
        yield
    finally:
        _QUIET.reset(before)


def reported(progress: Report | bool | None, label: str) -> AbstractContextManager[Report | None]:
    """What is to be called with the share done.

    ``progress``: that itself, or whether to show a bar; None shows one in a notebook alone
    """
    shell = _notebook()
    if callable(progress):
        return nullcontext(progress)
    if progress is False or (progress is None and (shell is None or _QUIET.get())):
        return nullcontext(None)
    return progress_bar(label) if shell is None else _in_notebook(label)


def running_shell() -> Any:
    """IPython's shell in this process; None where there is none, and IPython isn't imported."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython is not None else None


def _notebook() -> Any:
    """The shell of a notebook that is run in this process; None where there is none."""
    shell = running_shell()
    return shell if hasattr(shell, "kernel") else None


@contextmanager
def _in_notebook(label: str) -> Iterator[Report]:
    from IPython.display import display

    began = last = monotonic()
    shown: Any = None

    def report(done: float, _available: bool) -> None:
        nonlocal shown, last
        now = monotonic()
        if now - began < LONG or now - last < REDRAWN:
            return
        last = now
        gone = f"{now - began:.0f} s gone"
        left = f", about {(now - began) * (1 / done - 1):.0f} s left" if done else ""
        text = f"{label}: {done:.0%}, {gone}{left}"
        bar = f'<progress value="{done:.3f}" max="1"></progress> {text}'
        bundle = {"text/html": bar, "text/plain": text}
        if shown is None:
            shown = display(bundle, raw=True, display_id=True)  # type: ignore[no-untyped-call]
        else:
            shown.update(bundle, raw=True)

    try:
        yield report
    finally:
        if shown is not None:
            shown.update({"text/html": "", "text/plain": ""}, raw=True)


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
                progress.update(task, completed=done, total=1.0, left="left")

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
            TextColumn("gone"),
            TimeRemainingColumn(compact=True),
            TextColumn("{task.fields[left]}"),
            console=Console(stderr=True),
            refresh_per_second=8,
        )
        progress.start()
        task = progress.add_task(self._label, total=None, left="")
        if self._done is not None:
            progress.update(task, completed=self._done, total=1.0, left="left")
        return progress, task
