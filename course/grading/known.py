"""The collection of known submissions, right and wrong, that the grader itself is tested and calibrated with.

``solutions/wrong/MODULE/NAME.py`` holds the functions that somebody has written wrongly; the rest of that submission
is the reference solution. Its docstring says what the mistake is, and three constants what must come of it:
``FUNCTION``, the function that is wrong; ``CAUGHT_BY``, the name of the check meant for it; ``MISTAKE``, the name of
the mistake that the student is told, or None where no message is meant. A fourth, ``SAYS``, is what the student is
told; one of the submissions that make a mistake says it. ``solutions/right/MODULE/NAME.py`` is a right
submission written differently.
"""

import ast
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from course.effects import PROJECT
from course.errors import CourseError
from course.grading.checks.trusted import TrustedModule
from course.modules import COURSE


@dataclass(frozen=True)
class Known:
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


def trusted(submission: Known) -> TrustedModule:
    """A known submission's functions, in this process."""
    module = ModuleType(submission.name)
    exec(
        compile(submission.source, f"{submission.name}.py", "exec", dont_inherit=True),
        module.__dict__,
    )
    return TrustedModule({name: getattr(module, name) for name in COURSE[submission.module]})


def known(module: str, folder: Path = PROJECT / "solutions") -> list[Known]:
    """A module's known submissions, the right ones first; ``CourseError`` where one lacks docstring or constant."""
    solution = (folder / f"{module}.py").read_text(encoding="utf-8")
    return [
        _read(path, module, solution, right=kind == "right")
        for kind in ("right", "wrong")
        for path in sorted((folder / kind / module).glob("*.py"))
    ]


def _read(path: Path, module: str, solution: str, *, right: bool) -> Known:
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
    return Known(module, path.stem, right, about, source, *what)
