"""Places in one's own modules, as editors know them: file and line, or cell and line of a notebook."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from course.engine.functions.notebook.needed import Place
from course.engine.functions.sources import is_notebook, place_in, program_of, told_place
from course.school.grading.checks.result import Result


def place_of(path: Path, module: str, function: str) -> Place:
    """Cell and line that begin a function, the first line where there is none; cell 0 in a program."""
    try:
        rows = program_of(path, module).decode("utf-8", "replace").split("\n")
    except OSError:
        return 0, 1
    begins = f"def {function}("
    # The last definition of a name is the one that counts.
    lines = [number for number, row in enumerate(rows, start=1) if row.startswith(begins)]
    return place_in(path, module, lines[-1] if lines else 1)


def told_of(path: Path, module: str, function: str) -> str:
    """The same as a message has it."""
    return told_place(path, place_of(path, module, function))


def located(result: Result, path: Path) -> Result:
    """A result that names cells where its module is a notebook's."""
    if not is_notebook(path):
        return result

    def there(line: int) -> str:
        cell, own = place_in(path, result.module, line)
        file = f'File "{path.name}"'
        return f"{file}, cell {cell}, line {own}" if cell else f"{file}, line {own}"

    return moved(result, there)


def moved(result: Result, there: Callable[[int], str]) -> Result:
    """A result that tells where the lines of its module stand elsewhere."""

    def told(text: str) -> str:
        pattern = rf'File "{result.module}\.py", line (\d+)'
        return re.sub(pattern, lambda found: there(int(found[1])), text)

    return replace(result, where=told(result.where), found=told(result.found))
