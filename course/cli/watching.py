"""Do something again whenever one of some files is saved."""

import time
from collections.abc import Callable, Iterable
from pathlib import Path

import click

from course.errors import CourseError

POLL = 0.4
"""Seconds between two looks at the files."""


def times(files: Iterable[Path]) -> list[int]:
    """When each file was saved last [ns]; 0 for one that isn't there."""
    found = []
    for file in files:
        try:
            found.append(file.stat().st_mtime_ns)
        except OSError:
            found.append(0)
    return found


def await_change(files: Callable[[], Iterable[Path]], seen: list[int]) -> None:
    """Wait until the files are no longer as they were ``seen`` by ``times``."""
    click.echo("watching; Ctrl-C ends it", err=True)
    while times(files()) == seen:
        time.sleep(POLL)


def again_and_again(work: Callable[[], None], files: Callable[[], Iterable[Path]]) -> None:
    """Do the work, and again whenever a file is saved, until Ctrl-C; mistakes in the input are told and waited out."""
    while True:
        seen = times(files())
        try:
            work()
        except (CourseError, NotImplementedError) as error:
            click.echo(f"error: {error}", err=True)
        await_change(files, seen)
