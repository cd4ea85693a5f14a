"""A module from a notebook: what its functions come to use, and nothing of what was tried out beside them.

Drawing, timing and `%magic` are right in a notebook, and would fail where a module is imported.
"""

import ast
import json
import re
from typing import Any

from course.grading.classes.engines import apart
from course.grading.classes.reachable import parsed, reachable
from course.grading.release.stubs import first_line
from course.grading.submissions import LARGEST_FILE, SubmissionError

_MAGIC = re.compile(r"\s*(?:%{1,2}[A-Za-z]|!(?!=)|\?)")
"""How a line for the notebook's own machinery begins."""


def notebook_source(module: str, name: str, content: bytes) -> bytes:
    """The file of a module that a notebook holds; ``SubmissionError`` where it is none, or defines no function."""
    (source,) = apart(_converted, [(module, content)]).values()
    if not source:
        why = (
            "is no notebook that can be read" if source is None else "defines none of its functions"
        )
        raise SubmissionError(f"{name}: {why}; hand in {module}.py")
    return source


def _converted(work: tuple[str, bytes]) -> bytes | None:
    """None for what is no notebook; empty where no function is defined."""
    module, content = work
    try:
        cells = _code_cells(json.loads(content))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    # A cell that is no Python is left out, as a notebook shows its mistake and goes on.
    text = "\n\n".join(cell for cell in cells if parsed(cell) is not None)
    tree = parsed(text)
    if tree is None:
        return None
    lines = text.splitlines()
    parts = {
        node.lineno: "\n".join(lines[first_line(node) - 1 : node.end_lineno])
        for node in reachable(module, tree, imports=True)
    }
    # What is on from the future comes first, or not at all.
    future = [
        ast.unparse(node)
        for node in tree.body
        if isinstance(node, ast.ImportFrom) and node.module == "__future__"
    ]
    if not parts:
        return b""
    source = "\n\n".join([*dict.fromkeys(future), *(parts[line] for line in sorted(parts))])
    return source.encode("utf-8", "replace")[:LARGEST_FILE] + b"\n"


def _code_cells(notebook: dict[str, Any]) -> list[str]:
    found = []
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            source = cell["source"]
            found.append(_without_magic(source if isinstance(source, str) else "".join(source)))
    return found


def _without_magic(cell: str) -> str:
    if cell.lstrip().startswith("%%"):
        return ""
    return "\n".join("" if _MAGIC.match(line) else line for line in cell.splitlines())
