"""What takes long to make and is the same for every test: one process of a run makes it, the others wait for it."""

import os
import time
from collections.abc import Callable
from pathlib import Path

import pytest

LONGEST = 240.0
"""Seconds in which a busy machine has made anything."""

Once = Callable[[str, Callable[[Path], None]], Path]
"""(name, what makes it at a path) -> that path, where it is."""


def shared_folder(factory: pytest.TempPathFactory) -> Path:
    """The folder for temporary files that all processes of this run have in common."""
    own = factory.getbasetemp()
    return own.parent if "PYTEST_XDIST_WORKER" in os.environ else own


def made_once(folder: Path, name: str, make: Callable[[Path], None]) -> Path:
    """Have it made by the first process that asks.

    Parameters
    ----------
    name : of the file or folder that ``make`` makes
    make : is given the path; what it raises fails the test that asked first, and the others say so

    Raises
    ------
    RuntimeError
        Another process has failed to make it, or takes too long.
    """
    path, begun, ended = (folder / f"{name}{end}" for end in ("", ".begun", ".ended"))
    try:
        # Only one process can make a folder.
        begun.mkdir()
    except FileExistsError:
        _wait(ended)
    else:
        said = "it was not made"
        try:
            make(path)
            said = ""
        finally:
            _write_whole(ended, said)
    if said := ended.read_text(encoding="utf-8"):
        raise RuntimeError(f"{path}: {said}; the test that asked first says why")
    return path


def _wait(ended: Path) -> None:
    latest = time.monotonic() + LONGEST
    while not ended.exists():
        if time.monotonic() > latest:
            raise RuntimeError(f"{ended} is not there after {LONGEST:g} s")
        time.sleep(0.1)


def _write_whole(path: Path, text: str) -> None:
    """Whoever sees the file sees all of it."""
    part = path.with_suffix(".part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)
