"""Everything that is checked in a module: its own checks, its convergence, its pictures and its speed."""

from __future__ import annotations

from importlib import import_module

from course.effects import COURSE
from course.errors import CourseError
from course.grading.checks.check import ModuleChecks
from course.grading.checks.order import ORDERS
from course.grading.checks.speed import SPEEDS
from course.grading.pictures.catalog import PICTURES
from course.grading.pictures.whole import NAME, WHOLE


def module_checks(module: str) -> ModuleChecks:
    """The checks of a module, function by function in the order of the course.

    Raises
    ------
    CourseError
        There is no such module.
    """
    if module == NAME:
        return WHOLE
    if module not in COURSE:
        raise CourseError(f"no module {module!r}; the modules are {', '.join(COURSE)}")
    own: ModuleChecks = import_module(f"course.grading.checks.{module}").CHECKS
    found = (
        *own.checks,
        *ORDERS.get(module, ()),
        *PICTURES.get(module, ()),
        *SPEEDS.get(module, ()),
    )
    place = {name: number for number, name in enumerate(COURSE[module])}
    return ModuleChecks(
        module, tuple(sorted(found, key=lambda check: place[check.function])), own.mistakes
    )
