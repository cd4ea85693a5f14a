"""A clock that a test turns, in the place of the one that time limits are told by."""

import threading

import pytest

from course.engine.render import render as render_scene
from course.engine.render import threads


class Clock:
    """Moves on by ``tick`` whenever a thread looks before it takes work, and stands still for the one that waits."""

    tick = 1.0

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now = 1000.0
        for module in (render_scene, threads):
            monkeypatch.setattr(module, "monotonic", self)

    def __call__(self) -> float:
        if threading.current_thread() is not threading.main_thread():
            self.now += self.tick
        return self.now
