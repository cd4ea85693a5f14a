"""Which functions are looked at, and how."""

from functools import lru_cache
from importlib import import_module

from course.base.errors import CourseError
from sitebuild.mistakes.look import Look


@lru_cache
def looks(function: str) -> tuple[Look, ...]:
    """The ways to look at MODULE.FUNCTION.

    Raises
    ------
    CourseError
        There are none.
    """
    module, _, name = function.partition(".")
    found: dict[str, tuple[Look, ...]] = import_module(f"sitebuild.mistakes.looks.{module}").LOOKS
    if name not in found:
        raise CourseError(f"docs/sitebuild/mistakes/looks/{module}.py has no look at {name}")
    return found[name]


def look(function: str, seen: int) -> Look:
    """Return one of them by its number."""
    return looks(function)[seen]


def look_at(function: str, name: str) -> int:
    """Return the number of the look that shows a wrong submission.

    Raises
    ------
    CourseError
        There is none.
    """
    found = looks(function)
    for number, each in enumerate(found):
        if name in each.names:
            return number
    for number, each in enumerate(found):
        if not each.names:
            return number
    raise CourseError(f"{function}: no look is for {name}")
