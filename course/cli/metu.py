"""METU scenes in commands: those that take them convert them to a folder that goes however the process ends."""

from __future__ import annotations

import os
import re
import shutil
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import click

from course.base.errors import CourseError, Ended, SceneError
from course.engine.formats.metu.suffixes import is_metu

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
    """The handling of signals to end.

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


if TYPE_CHECKING:
    from course.engine.formats.metu.converting import Converted


def check_not_metu(scene: Path, command: str) -> None:
    """CourseError for a METU scene, for a command that has nothing to do with them but by way of `convert`."""
    if is_metu(scene):
        raise CourseError(
            f"{scene}: a METU scene, and `course {command}` takes scene files of this course: "
            f"`course convert {scene}` makes one of it"
        )


def check_camera(scene: Path, camera: str | None) -> None:
    """CourseError for a camera that is asked for where there is nothing to choose."""
    if camera is not None and not is_metu(scene):
        raise CourseError("--camera is for METU scenes, .xml or .json; others have one camera")


@contextmanager
def converted(scene: Path, camera: str | None) -> Iterator[list[Converted]]:
    """Scene files of a METU scene, one for each camera or for the one that is asked for, in a folder that goes.

    Warnings are printed.

    Raises
    ------
    CourseError
        There is no such camera.
    SceneError
        A mistake in the scene.
    """
    from course.engine.formats.metu.converting import convert

    with temporary_folder() as folder:
        found, warnings = convert(scene, folder / "scene.yaml")
        for warning in warnings:
            click.echo(f"warning: {warning}", err=True)
        chosen = [one for one in found if camera in (None, one.camera)]
        if not chosen:
            names = ", ".join(one.camera for one in found)
            raise CourseError(f"--camera {camera}: {scene} has the cameras {names}")
        yield chosen


@contextmanager
def told_of(scene: Path, file: Path) -> Iterator[None]:
    """Mistakes of a file that a METU scene was converted to are told as mistakes of that scene."""
    try:
        yield
    except SceneError as error:
        if file == scene:
            raise
        from course.engine.formats.metu.converting import retold

        raise retold(error, scene, file) from error


def without_place(text: str, scene: Path, file: Path) -> str:
    """A text that names places in the converted file, which nobody sees, with the METU scene in their stead."""
    return re.sub(rf"{re.escape(str(file))}(:\d+)?", lambda _: str(scene), text)
