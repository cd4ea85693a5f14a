"""Everything that is checked in a module: what is declared of its functions, and their pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

from course.errors import CourseError
from course.grading.checks.building import declared
from course.grading.checks.check import ModuleChecks
from course.grading.checks.declarations import declarations
from course.grading.checks.declare import Module
from course.grading.checks.weights import weighted
from course.grading.pictures.catalog import PICTURES
from course.grading.pictures.whole import ALL, NAME, WHOLE
from course.modules import COURSE


@cache
def module_checks(module: str) -> ModuleChecks:
    """A module's checks, by function in the order of the course; ``CourseError`` where no module has that name."""
    if module == NAME:
        return WHOLE
    if module not in COURSE:
        raise CourseError(f"no module {module!r}; the modules are {', '.join(COURSE)}")
    own = declared(Module(module, declarations(module)))
    place = {name: number for number, name in enumerate(COURSE[module])}
    checks = sorted(
        (*own.checks, *PICTURES.get(module, ())), key=lambda check: place[check.function]
    )
    return replace(own, checks=weighted(checks))


def with_whole(modules: Sequence[str]) -> tuple[str, ...]:
    """The modules whose checks are run: with all of the course's comes the one for all of them together."""
    return (*modules, *([NAME] if set(ALL) <= set(modules) else []))
