"""Each process of a run reads another share of the test files first, and keeps on disk what it has made of them.

All of them need all files, and would make the same of each at the same time: in a fresh copy that took three quarters
of the time until the first test. What another one has made is read from disk.
"""

import os
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module
from pathlib import Path

import pytest


def read_a_share(asked: Sequence[str], root: Path) -> list[str]:
    """Import this process's share of the test modules that were asked for; return their names.

    What goes wrong is left for when the file's tests are collected, which imports it again and tells it.

    Parameters
    ----------
    asked : files and folders, as pytest is given them
    root : the folder from which modules have their names
    """
    number = os.environ.get("PYTEST_XDIST_WORKER", "").removeprefix("gw")
    if not number:
        return []
    files: dict[Path, None] = {}
    for each in asked:
        path = root / each.partition("::")[0]
        files |= dict.fromkeys(sorted(path.rglob("test_*.py")) if path.is_dir() else [path])
    count = int(os.environ["PYTEST_XDIST_WORKER_COUNT"])
    names = []
    for path in [*files][int(number) :: count]:
        if name := _module(path, root):
            names.append(name)
            with suppress(Exception, pytest.skip.Exception):
                # What its tests have in common may put folders on Python's path.
                if (common := path.with_name("conftest.py")).exists():
                    import_module(_module(common, root))
                import_module(name)
    return names


def _module(path: Path, root: Path) -> str:
    """The name that pytest gives a file as a module; empty if it stands elsewhere."""
    if path.suffix != ".py" or not path.is_relative_to(root):
        return ""
    return ".".join(path.relative_to(root).with_suffix("").parts)
