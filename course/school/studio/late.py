"""Functions that are looked up when they are called, so that a scene can be compiled before they exist."""

import sys
import threading
from collections.abc import Callable, Iterable
from pathlib import Path
from time import monotonic
from typing import Any

from course.engine.functions.effects import Effects
from course.engine.recording.stages import RecordedEffects

IMPORTING = "importing"
"""Stands for the function's name while files are imported."""


class LateEffects(Effects):
    """Functions of ``source``, which may be exchanged after a scene was compiled with them.

    ``called`` : those that have been called, "module.function"
    """

    def __init__(self, source: Effects) -> None:
        self._use(source)

    def _use(self, source: Effects) -> None:
        # Who asks for a folder, or what is written in it, is told that of the source.
        vars(self).update(vars(source))
        self.source = source
        self.called: set[str] = set()
        self._busy: dict[int, tuple[str, float]] = {}

    def function(self, module: str, name: str) -> Callable[..., Any]:
        """See ``Effects``."""
        full = f"{module}.{name}"

        def call(*arguments: Any) -> Any:
            thread = threading.get_ident()
            self._busy[thread] = full, monotonic()
            self.called.add(full)
            try:
                return self.source.function(module, name)(*arguments)
            finally:
                self._busy.pop(thread, None)

        return call

    def load(self, source: Effects, functions: Iterable[str]) -> None:
        """Take the functions of another source; its files are imported by this thread.

        Raises EffectError: a file or a function is missing.
        """
        self._use(source)
        thread = threading.get_ident()
        self._busy[thread] = IMPORTING, monotonic()
        try:
            for each in functions:
                source.function(*each.split("."))
        finally:
            self._busy.pop(thread, None)

    def longest(self) -> tuple[str, float, int] | None:
        """The call that has lasted longest, its seconds, and its line in a file of the functions, 0 if elsewhere."""
        calls = list(self._busy.items())
        if not calls:
            return None
        thread, (name, since) = min(calls, key=lambda each: each[1][1])
        folder, line = self.source.folder.resolve(), 0
        frame = sys._current_frames().get(thread)
        while frame is not None and not line:
            if Path(frame.f_code.co_filename).parent == folder:
                line = frame.f_lineno
            frame = frame.f_back
        return name, monotonic() - since, line


class StudioEffects(RecordedEffects):
    """Late functions whose calls can be recorded."""

    def __init__(self, source: Effects) -> None:
        self.late = LateEffects(source)
        super().__init__(self.late)

    def load(self, source: Effects, functions: Iterable[str]) -> None:
        """See ``LateEffects``."""
        vars(self).update(vars(source))
        self.late.load(source, functions)
