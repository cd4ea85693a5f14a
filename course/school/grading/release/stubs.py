"""Stubs: what a solution leaves when its regions are taken out.

- A region in a public function becomes a TODO and a NotImplementedError, both with the task's id, ``module.function``.
- A region at module level vanishes. It holds the helpers and constants that only the solution uses.
- An import that nothing uses any more vanishes by itself; NumPy stays, for students write with it.

A solution is refused rather than published in part: each public function has a region, and whatever else stands
outside the regions must be used by what the students get, as the checks of shape and range are.

A region runs from a line ``### BEGIN SOLUTION`` to the next ``### END SOLUTION``, each alone on its line and both
indented alike. Lines are read as text, not as Python, so that nothing can hide a marker; what nearly is a marker is
refused rather than overlooked, for the price of overlooking one is a published solution.
"""

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TypeGuard

from course.base.errors import CourseError
from course.engine.functions.notebook.reachable import first_line

BEGIN = "### BEGIN SOLUTION"
END = "### END SOLUTION"

_NEARLY = re.compile(r"#.*\b(begin|end)[\s_-]*solution", re.IGNORECASE)

_KEPT = {"np", "annotations"}
"""Imported names that a stub keeps even where it doesn't use them."""


class SolutionError(CourseError):
    """A solution from which no stub can be made; the message names file and line."""


@dataclass(frozen=True)
class Region:
    """Where one region stands.

    Attributes
    ----------
    begin, end : numbers of the lines that hold the two markers, counted from 1
    indent : the white space before both
    """

    begin: int
    end: int
    indent: str


@dataclass(frozen=True)
class Stub:
    """A module as students get it.

    Attributes
    ----------
    text : the whole file
    tasks : ids of what is to be written, "module.function", in the order of the file
    """

    module: str
    text: str
    tasks: tuple[str, ...]

    def written(self, text: str) -> list[str]:
        """Tasks of which a student's copy of this file has the function, but no longer its error."""
        return [
            task
            for task in self.tasks
            if re.search(rf"^def {task.partition('.')[2]}\b", text, re.MULTILINE)
            and _not_written(task) not in text
        ]


def find_regions(text: str, file: str) -> list[Region]:
    """Find the regions of a text, from top to bottom.

    Raises SolutionError: a region is not closed, begins within another or ends without having begun; its markers are
    indented differently; or a marker is misspelt or shares its line.
    ``file``: what error messages call the text
    """
    regions = []
    opened: tuple[int, str] | None = None
    for number, line in enumerate(text.split("\n"), start=1):
        marker = line.strip()
        indent = line[: len(line) - len(line.lstrip())]
        if marker == BEGIN:
            if opened:
                raise SolutionError(
                    f"{file}:{number}: a region begins inside the one that line {opened[0]} opened"
                )
            opened = number, indent
        elif marker == END:
            if not opened:
                raise SolutionError(f"{file}:{number}: {END!r} closes no region")
            if indent != opened[1]:
                raise SolutionError(
                    f"{file}:{number}: {END!r} is not indented like its beginning in line {opened[0]}"
                )
            regions.append(Region(opened[0], number, indent))
            opened = None
        elif _NEARLY.search(line):
            raise SolutionError(
                f"{file}:{number}: {marker!r} is no marker: "
                f"expected {BEGIN!r} or {END!r}, alone on its line"
            )
    if opened:
        raise SolutionError(f"{file}:{opened[0]}: the region that begins here is never closed")
    return regions


def make_stubs(folder: Path) -> list[Stub]:
    """Make the stub of each solution in a folder, in the order of their names.

    Raises SolutionError: the folder isn't there or is empty, a file can't be read, or as `make_stub` does.
    """
    files = [path for path in sorted(folder.glob("*.py")) if not path.stem.startswith("_")]
    if not files:
        raise SolutionError(f"{folder}: there are no solutions (*.py) to make stubs from")
    return [make_stub(_read(path), path.stem, f"{folder.name}/{path.name}") for path in files]


def make_stub(text: str, module: str, file: str) -> Stub:
    """Make a stub of a solution.

    Raises SolutionError: a region is not as `find_regions` wants it, cuts a statement in two or stands where no task
    is; or something of the solution would be published.

    Parameters
    ----------
    text : of the solution
    module : first half of the tasks' ids
    file : what error messages call the text
    """
    regions = find_regions(text, file)
    tree = _parse(text, file)
    _check_cuts(tree, regions, file)
    owners = [_owner(tree, region, file) for region in regions]
    _check_tasks(tree, regions, owners, file)

    lines = text.split("\n")
    for region, owner in reversed([*zip(regions, owners, strict=True)]):
        if owner is None:
            _remove(lines, region.begin, region.end)
        else:
            task = f"{module}.{owner}"
            lines[region.begin - 1 : region.end] = [
                f"{region.indent}# TODO {task}: write your solution here",
                f"{region.indent}raise {_not_written(task)}",
            ]
    _remove_unused_imports(lines, _parse("\n".join(lines), f"{file} (without its regions)"))
    stub = "\n".join(lines).strip("\n") + "\n"
    _check_leftovers(tree, ast.parse(stub), file)
    # Names once each, though a function may have several regions.
    tasks = dict.fromkeys(f"{module}.{owner}" for owner in owners if owner is not None)
    return Stub(module, stub, tuple(tasks))


def _not_written(task: str) -> str:
    return f'NotImplementedError("{task}: not written yet")'


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise SolutionError(f"{path}: can't be read: {error}") from error


def _parse(text: str, file: str) -> ast.Module:
    try:
        return ast.parse(text)
    except (SyntaxError, ValueError) as error:
        line = getattr(error, "lineno", None) or 1
        raise SolutionError(f"{file}:{line}: not Python: {error}") from error


def _check_cuts(tree: ast.Module, regions: list[Region], file: str) -> None:
    """Refuse a region that holds part of a statement, or that stands in a text."""
    for node in ast.walk(tree):
        if not isinstance(node, ast.stmt):
            continue
        first, last = first_line(node), node.end_lineno or node.lineno
        holds_statements = hasattr(node, "body") or hasattr(node, "cases")
        for region in regions:
            apart = last < region.begin or region.end < first
            within = region.begin < first and last < region.end
            around = holds_statements and first < region.begin
            if not (apart or within or around):
                raise SolutionError(
                    f"{file}:{region.begin}: the region cuts the statement of line {first} in two"
                )


def _owner(tree: ast.Module, region: Region, file: str) -> str | None:
    """Name of the public function in which a region stands; None for one at module level."""
    if not region.indent:
        return None
    before = [node for node in tree.body if first_line(node) < region.begin]
    if before and _is_task(before[-1]):
        return before[-1].name
    raise SolutionError(
        f"{file}:{region.begin}: a region stands in a public function or at module level"
    )


def _is_task(node: ast.stmt) -> TypeGuard[ast.FunctionDef]:
    return isinstance(node, ast.FunctionDef) and not node.name.startswith("_")


def _check_tasks(
    tree: ast.Module, regions: list[Region], owners: list[str | None], file: str
) -> None:
    """Refuse a public function that students would get whole, or not at all."""
    for node in filter(_is_task, tree.body):
        if any(region.begin < node.lineno < region.end for region in regions):
            raise SolutionError(
                f"{file}:{node.lineno}: {node.name} stands inside a region, so no stub would have it"
            )
        if node.name not in owners:
            raise SolutionError(
                f"{file}:{node.lineno}: {node.name} has no region, so its stub would be the solution"
            )


def _remove(lines: list[str], first: int, last: int) -> None:
    """Remove lines counted from 1; of the blank ones around them the longer run stays."""
    start, stop = first - 1, last
    while start > 0 and not lines[start - 1].strip():
        start -= 1
    while stop < len(lines) and not lines[stop].strip():
        stop += 1
    lines[start:stop] = [""] * max(first - 1 - start, stop - last)


def _remove_unused_imports(lines: list[str], tree: ast.Module) -> None:
    used = set(_names(tree)) | _KEPT
    for node in reversed(tree.body):
        if not isinstance(node, ast.Import | ast.ImportFrom):
            continue
        kept = [a for a in node.names if (a.asname or a.name.partition(".")[0]) in used]
        if not kept:
            _remove(lines, node.lineno, node.end_lineno or node.lineno)
        elif kept != node.names:
            node.names = kept
            lines[node.lineno - 1 : node.end_lineno] = [ast.unparse(node)]


def _check_leftovers(solution: ast.Module, stub: ast.Module, file: str) -> None:
    """Refuse helpers and constants that only the solution uses: they are part of it."""
    uses: dict[str, set[str]] = {}
    reached: set[str] = set()
    for node in stub.body:
        names = [] if _is_task(node) else _defined(node)
        for name in names:
            uses.setdefault(name, set()).update(_names(node))
        if not names:
            reached.update(_names(node))
    new = set(reached)
    while new:
        new = {used for name in new for used in uses.get(name, ())} - reached
        reached |= new
    for node in solution.body:
        for name in _defined(node):
            if name in uses and name not in reached:
                raise SolutionError(
                    f"{file}:{node.lineno}: {name} serves nothing but the solution: "
                    "put it in a region at module level"
                )


def _defined(node: ast.stmt) -> list[str]:
    """Names that a definition or an assignment makes."""
    match node:
        case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
            return [node.name]
        case ast.Assign() | ast.AnnAssign():
            return [n.id for n in ast.walk(node) if _is_name(n) and isinstance(n.ctx, ast.Store)]
    return []


def _names(node: ast.AST) -> Iterator[str]:
    """Names that are read anywhere in a piece of code."""
    for inner in ast.walk(node):
        if _is_name(inner) and isinstance(inner.ctx, ast.Load):
            yield inner.id


def _is_name(node: ast.AST) -> TypeGuard[ast.Name]:
    return isinstance(node, ast.Name)
