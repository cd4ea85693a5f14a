"""Everything that is checked in a module: from its declarations and pictures to checks, and what each is worth.

A function is worth ten points, most of them for what a function of no use can't do. So one that is of no use earns at
most a fifth, whatever conventions it keeps, and one that is wrong in a corner keeps most of its points. The known
submissions show both.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache, partial
from time import perf_counter

import numpy as np

from course.base.errors import CourseError
from course.engine.functions.modules import COURSE, meant
from course.school.grading.checks.check import Check, ModuleChecks, Role, Trial
from course.school.grading.checks.conventions import conventions
from course.school.grading.checks.declare import Function, Law, declarations
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.examples import fewest_columns
from course.school.grading.checks.mistakes import mistake_of, prints
from course.school.grading.pictures.catalog import PICTURES, RAYS
from course.school.grading.pictures.whole import ALL, NAME, WHOLE


@cache
def module_checks(module: str) -> ModuleChecks:
    """A module's checks, by function in the order of the course; ``CourseError`` where no module has that name."""
    if module == NAME:
        return WHOLE
    if module not in COURSE:
        raise CourseError(f"no module {module!r}; the modules are {', '.join(COURSE)}")
    declared = declarations(module)
    checks = [check for function in declared for check in _declared(function)]
    place = {name: number for number, name in enumerate(COURSE[module])}
    checks = sorted((*checks, *PICTURES[module]), key=lambda check: place[check.function])
    return ModuleChecks(
        module,
        _weighted(checks),
        rays=RAYS[module],
        prints={function.name: prints(module, function) for function in declared},
        named={function.name: partial(mistake_of, function) for function in declared},
    )


def meant_check(only: str, modules: Iterable[str]) -> str:
    """Which function or check may be meant by what was asked for and isn't one; empty where none is alike.

    ``only``: FUNCTION or FUNCTION/CHECK
    """
    checks = [check for module in modules for check in module_checks(module).checks]
    names = {check.function for check in checks}
    function, _, name = only.partition("/")
    if function in names:
        near = meant(name, [check.name for check in checks if check.function == function])
        return f"; did you mean {function}/{near}?" if near else ""
    near = meant(function, names)
    return f"; did you mean {near}?" if near else ""


def with_whole(modules: Sequence[str]) -> tuple[str, ...]:
    """The modules whose checks are run: with all of the course's comes the one for all of them together."""
    return (*modules, *([NAME] if set(ALL) <= set(modules) else []))


# ---------------------------------------------------------------- from declarations to checks

SLOW = 10.0
"""Times the reference's time from which a note is made."""

ROUNDS = 3


def _declared(function: Function) -> Iterator[Check]:
    """The checks of the conventions, one for each law, and one of the time it takes."""
    besides = (replace(o.beside, name=f"{o.name}-alike") for o in function.laws if o.beside)
    for law in (*conventions(function), *function.laws, *besides):
        yield _check(function, law)
    if function.speed:
        timed = partial(_speed, function)
        title = "Its time beside the reference's (advice)"
        yield Check(function.name, "speed", title, timed, "speed", points=0)


def _check(function: Function, law: Law) -> Check:
    return Check(
        function.name,
        law.name,
        law.title,
        partial(law.run, function),
        law.kind,
        law.points,
        law.false_fail,
        role=law.role,
        smallest=partial(fewest_columns, function, law),
    )


def _speed(function: Function, trial: Trial) -> None:
    a = function.make(Draw(trial.rng, function.speed, np.float32))
    if trial.reference_caller is None:
        # Nothing to compare with; but what gives no value has not passed.
        trial.call(*a.values())
        return
    times: tuple[list[float], list[float]] = ([], [])
    for _ in range(ROUNDS):
        for caller, kept in zip((trial.caller, trial.reference_caller), times, strict=True):
            started = perf_counter()
            caller.call(function.name, *a.values())
            kept.append(perf_counter() - started)
    yours, reference = min(times[0]), min(times[1])
    if yours > SLOW * reference:
        trial.notes.append(
            f"It takes {yours / reference:.0f} times as long as the reference ({yours * 1e3:.0f} ms for "
            f"{function.speed} columns): whole arrays instead of loops would help."
        )


# ---------------------------------------------------------------- points

POINTS = 10.0
"""Of a function."""

SHARES: dict[Role, float] = {"core": 0.8, "corner": 0.15, "convention": 0.05}
"""Of a function's points; without checks of a role its share goes to the core."""


def _weighted(checks: Sequence[Check]) -> tuple[Check, ...]:
    """The same checks, their points shared out among those of a function and a role by their weights."""
    weights: dict[str, dict[Role, float]] = defaultdict(lambda: defaultdict(float))
    for check in checks:
        weights[check.function][check.role] += check.points
    return tuple(replace(check, points=_points(check, weights[check.function])) for check in checks)


def _points(check: Check, weights: dict[Role, float]) -> float:
    if not check.points:
        return 0.0
    shares = {role: SHARES[role] for role, weight in weights.items() if weight}
    share = shares[check.role]
    if check.role == "core":
        share = 1 - sum(other for role, other in shares.items() if role != "core")
    return POINTS * share * check.points / weights[check.role]
