"""How far one's own functions are: checked where they have changed, and remembered where they haven't."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

from course.base.atomic import write_text
from course.base.errors import OutputError
from course.base.version import __version__
from course.engine.functions.effects import PACKAGE
from course.engine.functions.modules import COURSE, WARM_UP
from course.engine.functions.sources import named, told_place
from course.school.grading.catalog import module_checks, with_whole
from course.school.grading.checks.check import Check
from course.school.grading.grading import grade
from course.school.grading.pictures.whole import ALL, NAME
from course.school.grading.places import place_of
from course.school.grading.references import references
from course.school.grading.report import FunctionResults, docs_page, findings, grouped, reproduce
from course.school.grading.submissions import find_modules, read_found
from course.school.grading.worker.sandbox import plain

KEPT = Path(".course", "checked.json")
"""In the folder of the functions: what checks have found, for files that haven't changed since."""


@dataclass(frozen=True)
class FunctionProgress:
    """How far one function is.

    Attributes
    ----------
    module, name : which one
    state : "right", "wrong", "to do" or "undecided"
    points, of : earned, and to be earned
    title, found : the first thing that is wrong: which law, and how it is broken; empty if there is none
    again : the command that runs this check again
    page : of the docs
    file, line : where the function begins
    cell : in which of a notebook's cells that line is; 0 in a program
    """

    module: str
    name: str
    state: str
    points: float
    of: float
    title: str
    found: str
    again: str
    page: str
    file: str
    line: int
    cell: int = 0

    @property
    def place(self) -> str:
        """Where it begins, as a message has it."""
        return told_place(self.file, (self.cell, self.line))


def progress(
    folder: Path,
    modules: Iterable[str] = tuple(COURSE),
    before: Callable[[str], None] = lambda _module: None,
    *,
    together: bool = False,
) -> Iterator[list[FunctionProgress]]:
    """The functions of one module after the other.

    Raises SubmissionError: a file can't be read.

    Parameters
    ----------
    folder : of the modules' files, or a notebook
    before : called with the name of each module that has to be checked
    together : whether after all core modules the picture follows that takes their functions together, as in a report
    """
    remembered = _remembered(folder)
    kept = _read(remembered)
    for module in with_whole(tuple(modules)) if together else modules:
        needed = ALL if module == NAME else (module,)
        paths = find_modules(folder, needed)
        sources = read_found(folder, paths)
        key = _key(*map(sources.get, needed))
        known = kept.get(module, {})
        if known.get("key") != key:
            before(module)
            known = {"key": key, "functions": _checked(folder, module, sources, paths)}
            kept = _read(remembered) | {module: known}
            _write(remembered, kept)
        file = folder if module == NAME else paths.get(module, named(folder, module))
        yield _placed(known["functions"], file)


def some_of(folder: Path, module: str, names: Collection[str]) -> list[FunctionProgress]:
    """Some functions of a module, checked before the others; none where that saves no time.

    Raises CourseError: the file can't be read.
    """
    paths = find_modules(folder, (module,))
    sources = read_found(folder, paths)
    known = _read(_remembered(folder)).get(module, {}).get("key") == _key(sources.get(module))
    if known or module not in sources or not 0 < len(names) < len(COURSE[module]):
        return []
    functions = _checked(folder, module, sources, paths, lambda check: check.function in names)
    return _placed(functions, paths[module])


def next_one(functions: list[FunctionProgress]) -> FunctionProgress | None:
    """What is wrong first, then what is to do in a module that somebody has begun, then in the others."""
    begun = {function.module for function in functions if function.state != "to do"}
    order = ("wrong", "to do", "undecided")
    left = [function for function in functions if function.state != "right"]
    ranked = sorted(
        left,
        key=lambda one: (order.index(one.state), one.module not in begun, one.module != WARM_UP),
    )
    return ranked[0] if ranked else None


def _checked(
    folder: Path,
    module: str,
    sources: dict[str, bytes],
    files: dict[str, Path],
    only: Callable[[Check], bool] | None = None,
) -> list[dict[str, Any]]:
    modules: tuple[str, ...] = (module,)
    if module == NAME:
        modules, only = ALL, module_checks(NAME).checks.__contains__
    report = grade(
        sources,
        references(),
        modules=modules,
        shut_in=plain(),
        only=only,
        folder=folder,
        files=files,
    )
    return [_told(function) for each in grouped(report) for function in each.functions]


def _placed(functions: list[dict[str, Any]], path: Path) -> list[FunctionProgress]:
    """With the file and the lines where they begin; the picture of all modules has a folder alone."""
    places = [
        (0, 1) if one["module"] == NAME else place_of(path, one["module"], one["name"])
        for one in functions
    ]
    return [
        FunctionProgress(**function, file=str(path), line=line, cell=cell)
        for function, (cell, line) in zip(functions, places, strict=True)
    ]


def _told(function: FunctionResults) -> dict[str, Any]:
    told = {
        "module": function.module,
        "name": function.name,
        "state": function.state,
        "points": function.points,
        "of": function.of,
        "title": "",
        "found": "",
        "again": "",
        "page": docs_page(function.results[0]),
    }
    if function.state in ("wrong", "undecided") and function.told:
        first = function.told[0]
        found = dict(findings(first, 1))
        told["title"] = first.found if first.module_wide else first.title
        # A number alone doesn't say whether it was found or expected.
        both = [f"{name} {found[name]}" for name in ("found", "expected") if found.get(name)]
        told["found"] = "; ".join(filter(None, (", ".join(both), found.get("hint"))))
        told["again"] = f"{reproduce(first, 0)} --hint 2"
    return told


# ---------------------------------------------------------------- what is remembered


def _remembered(folder: Path) -> Path:
    """Where it is; beside a notebook that is given alone."""
    return (folder.parent if folder.is_file() else folder) / KEPT


def _key(*sources: bytes | None) -> str:
    texts = [b"missing" if source is None else source for source in sources]
    return hashlib.sha256(b"\0".join(texts)).hexdigest()


@cache
def _checks() -> str:
    """What results depend on beside the file: the version, and when the checks were changed last."""
    newest = max(path.stat().st_mtime_ns for path in (PACKAGE / "school" / "grading").rglob("*.py"))
    return f"{__version__} {newest}"


def _read(path: Path) -> dict[str, Any]:
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        return dict(document["modules"]) if document["checks"] == _checks() else {}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


def _write(path: Path, modules: dict[str, Any]) -> None:
    try:
        path.parent.mkdir(exist_ok=True)
        write_text(path.parent / ".gitignore", "*\n")
        write_text(path, json.dumps({"checks": _checks(), "modules": modules}))
    except (OSError, OutputError):
        # A folder that can't be written to is checked each time.
        return


def as_data(functions: Iterable[FunctionProgress]) -> list[dict[str, Any]]:
    """Plain data."""
    return [asdict(function) for function in functions]
