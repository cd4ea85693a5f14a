"""Places in one's own modules, as editors know them: file and line, or cell and line of a notebook."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from course.engine.functions.sources import (
    cell_name,
    is_notebook,
    place_in,
    program_of,
    told_place,
)
from course.school.grading.checks.result import Result

if TYPE_CHECKING:
    # It reads notebooks, with IPython, which takes a fifth of a second to import.
    from course.engine.functions.notebook.needed import Place


def place_of(path: Path, module: str, function: str) -> Place:
    """Cell and line that begin a function, the first line where there is none; cell 0 in a program."""
    try:
        rows = program_of(path, module).decode("utf-8", "replace").split("\n")
    except OSError:
        return 0, 1
    return place_in(path, module, _line_of(rows, function) or 1)


def told_of(path: Path, module: str, function: str) -> str:
    """The same as a message has it; the notebook alone where none of its cells has the function."""
    if is_notebook(path) and not _line_of(program_of(path, module).decode().split("\n"), function):
        return str(path)
    return told_place(path, place_of(path, module, function))


def _line_of(rows: list[str], function: str) -> int:
    """The line that begins a function, by ``def`` or as a value; 0 where there is none."""
    begins = re.compile(rf"def {function}\(|{function}\s*=(?!=)")
    # The last definition of a name is the one that counts.
    return max((number for number, row in enumerate(rows, 1) if begins.match(row)), default=0)


def located(result: Result, path: Path) -> Result:
    """A result that names cells where its module is a notebook's."""
    if not is_notebook(path):
        return result

    def there(line: int) -> str:
        cell, own = place_in(path, result.module, line)
        file = f'File "{path.name}"'
        return f"{file}, {cell_name(path, cell)}, line {own}" if cell else f"{file}, line {own}"

    return moved(result, there, path.name)


def moved(result: Result, there: Callable[[int], str], name: str) -> Result:
    """A result that tells where the lines of its module stand elsewhere.

    ``name``: what is said in the place of the program's
    """

    def told(text: str) -> str:
        pattern = rf'File "{result.module}\.py", line (\d+)'
        text = re.sub(pattern, lambda found: there(int(found[1])), text)
        return re.sub(rf'(?<![\w/"]){result.module}\.py\b', lambda _: name, text)

    return replace(result, where=told(result.where), found=told(result.found))
