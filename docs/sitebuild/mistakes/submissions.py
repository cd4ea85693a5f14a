"""Functions to be looked at: the right ones of all modules, and the known wrong ones."""

from collections.abc import Callable
from functools import lru_cache
from types import ModuleType
from typing import Any

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from course.school.grading.known import KnownSubmission, known

Function = Callable[..., Any]


def solution(module: str) -> str:
    """Text of a module's right functions."""
    return (PROJECT / "solutions" / f"{module}.py").read_text(encoding="utf-8")


def submission(function: str, name: str) -> KnownSubmission:
    """Find a known wrong submission of MODULE.FUNCTION.

    Raises
    ------
    CourseError
        There is none of that name, or it is of another function.
    """
    module, _, of = function.partition(".")
    for each in _all_of(module):
        if not each.right and each.name == name:
            if each.function != of:
                raise CourseError(f"solutions/wrong: {module}'s {name} is of {each.function}")
            return each
    raise CourseError(f"solutions/wrong: {module} has no {name}")


@lru_cache
def _all_of(module: str) -> list[KnownSubmission]:
    return known(module)


@lru_cache
def functions(module: str, name: str = "") -> ModuleType:
    """A module's functions, with one of them wrong if a submission of that name is asked for."""
    source = solution(module)
    if name:
        source = next(each.source for each in _all_of(module) if each.name == name)
    made = ModuleType(name or module)
    exec(compile(source, f"{name or module}.py", "exec", dont_inherit=True), made.__dict__)
    return made
