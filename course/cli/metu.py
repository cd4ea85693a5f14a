"""METU scenes in commands: those that take them convert them to a temporary folder, the others say what to do."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from course.cli.temporary import temporary_folder
from course.errors import CourseError, SceneError
from course.formats.metu.suffixes import is_metu

if TYPE_CHECKING:
    from course.formats.metu.converting import Converted


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
    from course.formats.metu.converting import convert

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
        from course.formats.metu.converting import retold

        raise retold(error, scene, file) from error


def without_place(text: str, scene: Path, file: Path) -> str:
    """A text that names places in the converted file, which nobody sees, with the METU scene in their stead."""
    return re.sub(rf"{re.escape(str(file))}(:\d+)?", lambda _: str(scene), text)
