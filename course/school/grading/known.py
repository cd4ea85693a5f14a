"""The collection of known submissions, right and wrong, that the grader itself is tested and calibrated with.

Most wrong ones are the solution with some of its lines changed: ``solutions/wrong/MODULE.yaml`` has them by function
and name, with what their mistake is (``about``), the check meant for it (``caught_by``), the name of the mistake that
the student is told (``mistake``; without it no message is meant), and what is said then (``says``; one of the
submissions that make a mistake says it). Each of the ``edits`` has lines of the solution, ``was``, and what stands in
their place, ``now``; ``in`` names their function where that is another one, and ``also`` has what stands behind all.

Those that are written otherwise are files, ``solutions/wrong/MODULE/NAME.py``: functions that take the place of the
solution's. The docstring says what the mistake is, and constants the rest: ``FUNCTION``, ``CAUGHT_BY``, ``MISTAKE`` (or
None) and ``SAYS``. ``solutions/right/MODULE/NAME.py`` is a right submission written differently.
"""

import ast
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from textwrap import dedent, indent
from types import ModuleType

import yaml
from msgspec import Struct, ValidationError, convert, field

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading.checks.trusted import TrustedModule


@dataclass(frozen=True)
class KnownSubmission:
    """One known submission of one module.

    Attributes
    ----------
    module, name : where it stands
    right : whether it is
    about : first line of its docstring
    source : the whole submission, a module's text
    function, caught_by, mistake : of a wrong one, else empty
    says : what the student is told who makes that mistake; one of several submissions that make it says it
    """

    module: str
    name: str
    right: bool
    about: str
    source: str
    function: str = ""
    caught_by: str = ""
    mistake: str = ""
    says: str = ""


def trusted(submission: KnownSubmission) -> TrustedModule:
    """A known submission's functions, in this process."""
    module = ModuleType(submission.name)
    exec(
        compile(submission.source, f"{submission.name}.py", "exec", dont_inherit=True),
        module.__dict__,
    )
    return TrustedModule({name: getattr(module, name) for name in COURSE[submission.module]})


def known(module: str, folder: Path = PROJECT / "solutions") -> list[KnownSubmission]:
    """A module's known submissions, the right ones first; ``CourseError`` where one lacks what it must say."""
    solution = (folder / f"{module}.py").read_text(encoding="utf-8")
    right, wrong = (
        [
            _read(path, module, solution, right=kind == "right")
            for path in sorted((folder / kind / module).glob("*.py"))
        ]
        for kind in ("right", "wrong")
    )
    edited = folder / "wrong" / f"{module}.yaml"
    if edited.exists():
        wrong += _edited(edited, module, solution)
    return [*right, *sorted(wrong, key=lambda each: each.name)]


class _Edit(Struct, forbid_unknown_fields=True):
    was: str
    now: str = ""
    within: str = field(default="", name="in")


class _Edited(Struct, forbid_unknown_fields=True):
    about: str
    caught_by: str
    edits: list[_Edit]
    mistake: str = ""
    says: str = ""
    also: str = ""


def _edited(path: Path, module: str, solution: str) -> list[KnownSubmission]:
    """The submissions of a module that are its solution with lines changed."""
    # Marks of what is left out in stubs stand between lines that belong together.
    plain = [line for line in solution.split("\n") if not line.lstrip().startswith("###")]
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        document = yaml.load(path.read_text(encoding="utf-8"), loader)
        functions = convert(document, dict[str, dict[str, _Edited]])
    except (ValidationError, yaml.YAMLError) as error:
        raise CourseError(f"{path}: {error}") from error
    found = []
    for function, submissions in functions.items():
        for name, each in submissions.items():
            lines = plain
            for edit in each.edits:
                try:
                    lines = _changed(lines, edit, edit.within or function)
                except ValueError as error:
                    raise CourseError(f"{path}: {function}.{name}: {error}") from error
            source = "\n".join([*lines, each.also])
            told = function, each.caught_by, each.mistake, each.says
            found.append(KnownSubmission(module, name, False, each.about, source, *told))
    return found


@lru_cache(maxsize=4)
def _spans(text: str) -> dict[str, tuple[int, int]]:
    """Where each function of a module's text begins and ends, in lines."""
    functions = [node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef)]
    return {node.name: (node.lineno - 1, node.end_lineno or 0) for node in functions}


def _changed(lines: list[str], edit: _Edit, function: str) -> list[str]:
    """Lines of a module with some of a function's changed; ValueError where these stand there never or twice."""
    spans = _spans("\n".join(lines))
    if function not in spans:
        raise ValueError(f"the solution has no function {function}")
    first, end = spans[function]
    was = edit.was.rstrip("\n").split("\n")
    places = [
        start
        for start in range(first, end - len(was) + 1)
        if dedent("\n".join(lines[start : start + len(was)])) == "\n".join(was)
    ]
    if len(places) != 1:
        raise ValueError(f"{was[0]!r} stands {len(places)} times in {function}; expected once")
    start = places[0]
    margin = lines[start][: len(lines[start]) - len(lines[start].lstrip())]
    now = edit.now.rstrip("\n").split("\n") if edit.now else []
    return [*lines[:start], *(indent(line, margin) for line in now), *lines[start + len(was) :]]


def _read(path: Path, module: str, solution: str, *, right: bool) -> KnownSubmission:
    text = path.read_text(encoding="utf-8")
    tree = ast.parse(text)
    about = (ast.get_docstring(tree) or "").partition("\n")[0]
    if not about:
        raise CourseError(f"{path}: needs a docstring that says what it is")
    # Later definitions win: what the file defines takes the place of the solution's.
    source = solution + "\n\n" + text.replace("from __future__ import annotations\n", "")
    constants = {
        node.targets[0].id: node.value.value
        for node in tree.body
        if isinstance(node, ast.Assign)
        and isinstance(node.targets[0], ast.Name)
        and isinstance(node.value, ast.Constant)
    }
    if not right and not {"FUNCTION", "CAUGHT_BY", "MISTAKE"} <= constants.keys():
        raise CourseError(f"{path}: needs FUNCTION, CAUGHT_BY and MISTAKE")
    told = ("FUNCTION", "CAUGHT_BY", "MISTAKE", "SAYS")
    what = ["" if right else str(constants.get(name) or "") for name in told]
    return KnownSubmission(module, path.stem, right, about, source, *what)
