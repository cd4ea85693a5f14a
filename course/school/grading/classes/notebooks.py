"""A module from a notebook: what its functions come to use, and nothing of what was tried out beside them.

Drawing, timing and rendering are right in a notebook, and would fail where a module is imported. Nothing of a notebook
is run here, its text is taken apart: but that can be made to take long, so it is done in a process apart.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import groupby
from typing import TYPE_CHECKING

from course.engine.functions.modules import COURSE
from course.school.grading.submissions import LARGEST_FILE, SubmissionError

if TYPE_CHECKING:
    from course.school.grading.classes.cells import Statement

MOST_TOLD = 8
"""Places that are told of one notebook."""


@dataclass(frozen=True)
class Notebook:
    """The modules that a notebook holds.

    Attributes
    ----------
    sources : module -> its text, made from the cells
    files : module -> its text, as a cell writes it into a file of the module's name
    told : what was left out of the cells
    """

    sources: dict[str, bytes] = field(default_factory=dict)
    files: dict[str, bytes] = field(default_factory=dict)
    told: tuple[str, ...] = ()


def read_notebook(name: str, content: bytes, modules: Iterable[str]) -> Notebook:
    """Read some modules from a notebook, in this process; ``SubmissionError`` where it is none.

    ``name``: of the file, for messages
    """
    found = converted((content, tuple(modules)))
    if isinstance(found, str):
        raise SubmissionError(f"{name}: is no notebook that can be read: {found}")
    return found


def converted(work: tuple[bytes, tuple[str, ...]]) -> Notebook | str:
    """The notebook, or why it is none."""
    # IPython takes a fifth of a second to import.
    from course.school.grading.classes.cells import NO_NOTEBOOK, read_cells
    from course.school.grading.classes.needed import Code

    content, modules = work
    try:
        cells = read_cells(content)
    except NO_NOTEBOOK as error:
        return str(error)[:80] if isinstance(error, ValueError) else "it has no cells"
    files = {
        module: cells.files[f"{module}.py"].encode("utf-8", "replace")[:LARGEST_FILE]
        for module in modules
        if f"{module}.py" in cells.files
    }
    others = [file for file in cells.files if file.removesuffix(".py") not in COURSE]
    told = [*cells.told, *(f"{file}, which a cell writes, is left out" for file in others)]
    code = Code(cells.statements, told)
    sources: dict[str, bytes] = {}
    left: list[Statement] = []
    for module in modules:
        text, beside = code.module(COURSE[module])
        if text:
            sources[module] = text.encode("utf-8", "replace")[:LARGEST_FILE] + b"\n"
            left = beside if len(sources) == 1 else [one for one in left if one in beside]
    if sources:
        told += _places(left)
    more = [f"{len(told) - MOST_TOLD} places more"] if len(told) > MOST_TOLD else []
    return Notebook(sources, files, (*told[:MOST_TOLD], *more))


def _places(left: list[Statement]) -> list[str]:
    """Where statements stand that no function needs, in a line."""
    places = []
    for cell, statements in groupby(left, key=lambda one: one.cell):
        lines = [str(one.line) for one in statements]
        more = ["..."] if len(lines) > MOST_TOLD else []
        listed = ", ".join(lines[:MOST_TOLD] + more)
        places.append(f"cell {cell}, line{'' if len(lines) == 1 else 's'} {listed}")
    if len(places) > MOST_TOLD:
        places[MOST_TOLD:] = [f"and {len(places) - MOST_TOLD} cells more"]
    return [f"left out, for no function needs it: {'; '.join(places)}"] if places else []
