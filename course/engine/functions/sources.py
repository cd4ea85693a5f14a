"""Where one's own modules are: programs and notebooks in a folder, or one notebook by itself.

The rules are those by which submissions are graded: a program goes before a notebook of the same name, and where no
name tells, a notebook holds the modules whose functions it defines.
"""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from course.base.errors import CourseWarning
from course.base.progress import running_shell
from course.engine.functions.modules import COURSE
from course.engine.functions.notebook.reading import (
    LARGEST_NOTEBOOK,
    NotebookError,
    modules_defined,
    read_notebook,
    with_counts,
)

if TYPE_CHECKING:
    from course.engine.functions.notebook.needed import Place

NOTEBOOK = ".ipynb"

MOST_LOOKED_INTO = 50
"""Notebooks of a folder that are looked into where no name tells."""

_MARK = f"{NOTEBOOK}, cell "
"""In the name of a cell's code, between the notebook's and the cell's number."""


@dataclass(frozen=True)
class ModuleCells:
    """What a notebook has of a module.

    Attributes
    ----------
    text : as a program
    places : where each of its lines stands: cell, and line in it; empty where a cell writes the program as a file
    told : what was left out
    """

    text: bytes
    places: tuple[Place, ...]
    told: tuple[str, ...]


def is_notebook(path: Path) -> bool:
    """Whether its name says so."""
    return path.suffix.lower() == NOTEBOOK


def find_module(folder: Path, module: str) -> Path | None:
    """The file in a folder that holds a module; None where there is none.

    Raises NotebookError: two notebooks of other names define functions of it.
    ``folder``: or a notebook or program alone
    """
    if folder.is_file():
        alone = holds(folder) if is_notebook(folder) else (folder.stem,)
        return folder if module in alone else None
    program, notebook = folder / f"{module}.py", folder / f"{module}{NOTEBOOK}"
    if program.is_file():
        if notebook.is_file():
            warnings.warn(
                f"{notebook} is left alone, for {program} goes before it: remove or rename one",
                CourseWarning,
                stacklevel=2,
            )
        return program
    if notebook.is_file():
        return notebook
    found = [path for path in _others(folder) if module in holds(path)]
    if len(found) > 1:
        listed = ", ".join(path.name for path in found)
        raise NotebookError(
            f"{folder}: {listed} define functions of {module}; name one {module}{NOTEBOOK}"
        )
    return found[0] if found else None


def _others(folder: Path) -> Iterator[Path]:
    """Notebooks that no module has its name from."""
    found = (path for path in sorted(folder.glob(f"*{NOTEBOOK}")) if path.stem not in COURSE)
    for path, _ in zip(found, range(MOST_LOOKED_INTO), strict=False):
        if path.is_file():
            yield path


def named(folder: Path, module: str) -> Path:
    """The file that a message tells of where a module is missing: a notebook where there is no program, but some."""
    if folder.is_file():
        return folder
    notebooks = any(folder.glob(f"*{NOTEBOOK}")) and not any(folder.glob("*.py"))
    return folder / f"{module}{NOTEBOOK if notebooks else '.py'}"


def holds(path: Path) -> tuple[str, ...]:
    """The modules of a notebook: the one of its name, and those whose functions it defines."""
    alone = (path.stem,) if path.stem in COURSE else ()
    told = path.stat()
    return alone or _defined(path, told.st_mtime_ns, told.st_size)


@lru_cache(maxsize=MOST_LOOKED_INTO)
def _defined(path: Path, _saved: int, _size: int) -> tuple[str, ...]:
    return tuple(modules_defined(_content(path), COURSE))


def _content(path: Path) -> bytes:
    # Here, for a command line's help needs no NumPy.
    from course.base.inputs import InputLimit, read_input

    return read_input(path, "notebook", InputLimit(LARGEST_NOTEBOOK), NotebookError)


def cells_of(path: Path, module: str) -> ModuleCells:
    """What a notebook has of a module; no text where it has nothing.

    Raises NotebookError: it is none, or can't be read.
    """
    told = path.stat()
    return _cells(path, module, told.st_mtime_ns, told.st_size)


@lru_cache(maxsize=2 * len(COURSE))
def _cells(path: Path, module: str, _saved: int, _size: int) -> ModuleCells:
    found = read_notebook(str(path), _content(path), [module])
    if module in found.files:
        return ModuleCells(found.files[module], (), found.told)
    places = tuple(found.places.get(module, ()))
    return ModuleCells(found.sources.get(module, b""), places, found.told)


def program_of(path: Path, module: str) -> bytes:
    """A module's file as a program."""
    return cells_of(path, module).text if is_notebook(path) else path.read_bytes()


def saved_files(folder: Path) -> list[Path]:
    """All files of a folder that may hold a module."""
    if folder.is_file():
        return [folder]
    return [*folder.glob("*.py"), *folder.glob(f"*{NOTEBOOK}")]


# ---------------------------------------------------------------- places


def place_in(path: Path, module: str, line: int) -> Place:
    """Cell and line of a line of a module's text; cell 0 for that of a program."""
    places = cells_of(path, module).places if is_notebook(path) and path.is_file() else ()
    return places[min(line, len(places)) - 1] if places else (0, line)


def told_place(path: Path | str, place: Place) -> str:
    """A place as a message has it: as editors know it in a program, by the cell's number in a notebook."""
    cell, line = place
    return f"{path}, {cell_name(Path(path), cell)}, line {line}" if cell else f"{path}:{line}"


def cell_name(path: Path, cell: int) -> str:
    """A cell as a message has it: where it stands, texts among the others, and the number that Jupyter shows."""
    told = path.stat() if path.is_file() else None
    counts = _counts(path, told.st_mtime_ns, told.st_size) if told else {}
    return with_counts(f"cell {cell}", counts)


@lru_cache(maxsize=2 * len(COURSE))
def _counts(path: Path, _saved: int, _size: int) -> dict[int, int]:
    # IPython takes a fifth of a second to import.
    from course.engine.functions.notebook.cells import NO_NOTEBOOK, counts_of

    try:
        return counts_of(json.loads(_content(path)))
    except (*NO_NOTEBOOK, NotebookError):
        return {}


def code_name(path: Path, cell: int) -> str:
    """What Python calls the code of a notebook's cell; `spot` makes a place of it."""
    return f"{path}, cell {cell}"


def spot(name: str, line: int, file: Path) -> str:
    """A line of code by what Python calls its file, as a message has it.

    ``file``: of the module, as it was given
    """
    if cell := _live(name):
        return f"{cell}, line {line}"
    stem, mark, number = name.rpartition(_MARK)
    if not mark:
        return told_place(file, (0, line))
    # What was imported has its whole path, however the file is called here.
    return f"{file}, {cell_name(Path(f'{stem}{NOTEBOOK}'), int(number))}, line {line}"


def _live(name: str) -> str:
    """The cell in which code was run, as the notebook numbers it; empty where it isn't of a notebook that is run."""
    shell = running_shell()
    # IPython 7, which Colab has, keeps no numbers.
    known = getattr(getattr(shell, "compile", None), "format_code_name", lambda _: None)(name)
    return f"cell {known[1]}" if known and known[0] == "Cell" else ""
