"""A module from a notebook: what its functions come to use, and nothing of what was tried out beside them.

Drawing, timing and rendering are right in a notebook, and would fail where a module is imported. Nothing of a notebook
is run here, its text is taken apart: but that can be made to take long, so it is done in a process apart.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import TYPE_CHECKING

from course.base.errors import CourseError
from course.engine.functions.modules import COURSE

if TYPE_CHECKING:
    from course.engine.functions.notebook.cells import NotebookCode, Statement
    from course.engine.functions.notebook.needed import Place

LARGEST_FILE = 2_000_000
"""Bytes of a file of functions that are read."""

UNNEEDED = "left out, for no function needs it"
"""How what is told of statements begins that try something out."""

LARGEST_NOTEBOOK = 20_000_000
"""Bytes; pictures are part of a notebook."""

_DEFINED = re.compile(rb'(?:^|"|\\n)[ \t]*(?:async\s+)?def\s+(\w+)', re.MULTILINE)
"""In a program at the beginning of a line, in a notebook at that of a string or after an escaped end of line."""

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
    places : module -> where each line of its text stands: cell, and line in it
    rebound : module -> names that it needs and several cells bind, with where they do; the last one counts
    """

    sources: dict[str, bytes] = field(default_factory=dict)
    files: dict[str, bytes] = field(default_factory=dict)
    told: tuple[str, ...] = ()
    places: dict[str, list[Place]] = field(default_factory=dict)
    rebound: dict[str, list[tuple[str, list[Place]]]] = field(default_factory=dict)


class NotebookError(CourseError):
    """A file that is no notebook; the message names it and says why."""


def read_notebook(name: str, content: bytes, modules: Iterable[str]) -> Notebook:
    """Read some modules from a notebook, in this process; ``NotebookError`` where it is none.

    ``name``: of the file, for messages
    """
    found = converted((content, tuple(modules)))
    if isinstance(found, str):
        raise NotebookError(f"{name}: is no notebook that can be read: {found}")
    return found


def converted(work: tuple[bytes, tuple[str, ...]]) -> Notebook | str:
    """The notebook, or why it is none."""
    from course.engine.functions.notebook.cells import NO_NOTEBOOK, read_cells

    content, modules = work
    try:
        cells = read_cells(content)
    except NO_NOTEBOOK as error:
        return str(error)[:80] if isinstance(error, ValueError) else "it has no cells"
    found = gathered(cells, modules)
    return replace(found, told=tuple(with_counts(told, cells.counts) for told in found.told))


def gathered(cells: NotebookCode, modules: Iterable[str]) -> Notebook:
    """Some modules, of what was read from cells."""
    # IPython takes a fifth of a second to import.
    from course.engine.functions.notebook.needed import Code

    files = {
        module: cells.files[f"{module}.py"].encode("utf-8", "replace")[:LARGEST_FILE]
        for module in modules
        if f"{module}.py" in cells.files
    }
    others = [file for file in cells.files if file.removesuffix(".py") not in COURSE]
    told = [*cells.told, *(f"{file}, which a cell writes, is left out" for file in others)]
    rebound: dict[str, list[tuple[str, list[Place]]]] = {}
    code = Code(cells.statements, told)
    sources: dict[str, bytes] = {}
    places: dict[str, list[Place]] = {}
    left: list[Statement] = []
    for module in modules:
        text, places[module], beside = code.module(COURSE[module])
        rebound[module] = [] if module in files else code.rebound()
        if text:
            sources[module] = text.encode("utf-8", "replace")[:LARGEST_FILE] + b"\n"
            left = beside if len(sources) == 1 else [one for one in left if one in beside]
    again = [_again(name, where) for one in rebound.values() for name, where in one]
    told[:0] = dict.fromkeys(again)
    if sources:
        told += _places(left)
    more = [f"{len(told) - MOST_TOLD} places more"] if len(told) > MOST_TOLD else []
    return Notebook(sources, files, (*told[:MOST_TOLD], *more), places, rebound)


def modules_defined(source: bytes, modules: Iterable[str]) -> list[str]:
    """Modules of which a file or notebook defines half of the functions, or else the one of which it defines most.

    Empty if there is none, or two of which it defines as many.
    """
    defined = {name.decode() for name in _DEFINED.findall(source)}
    count = {module: len(defined & {*COURSE[module]}) for module in modules}
    halves = [module for module, number in count.items() if 2 * number >= len(COURSE[module])]
    most = max(count.values(), default=0)
    found = [module for module, number in count.items() if number == most > 0]
    return halves or (found if len(found) == 1 else [])


def _again(name: str, where: Sequence[Place]) -> str:
    """That a name is bound by several cells, and which of them counts."""
    *before, (cell, line) = where
    others = ", ".join(str(one) for one, _ in before[-MOST_TOLD:])
    cells, verb = ("cell", "does") if len(before) == 1 else ("cells", "do")
    return f"cell {cell}, line {line}: binds {name}, which {cells} {others} above {verb}, too: cell {cell} counts"


def with_counts(text: str, counts: Mapping[int, int]) -> str:
    """What is told of cells, with the number that a notebook shows beside each: cell 8 (In[5])."""
    return re.sub(
        r"\bcell (\d+)",
        lambda found: found[0] + (f" (In[{counts[n]}])" if (n := int(found[1])) in counts else ""),
        text,
    )


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
    return [f"{UNNEEDED}: {'; '.join(places)}"] if places else []
