"""From declarations to checks: those of the conventions, a check for each law, and one of the time it takes."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from time import perf_counter

import numpy as np

from course.grading.checks.check import Check, Failure, ModuleChecks, Trial
from course.grading.checks.conventions import conventions
from course.grading.checks.declare import Function, Law, Module
from course.grading.checks.drawing import Draw
from course.grading.checks.examples import fewest_columns
from course.grading.checks.mistakes import mistake_of, prints
from course.grading.errors import StudentError

SLOW = 10.0
"""Times the reference's time from which a note is made."""

ROUNDS = 3


def declared(module: Module) -> ModuleChecks:
    """All checks of a declared module."""
    checks = []
    for function in module.functions:
        besides = (replace(o.beside, name=f"{o.name}-alike") for o in function.laws if o.beside)
        laws = (*conventions(function), *function.laws, *besides)
        checks += [_check(function, law) for law in laws]
        if function.speed:
            run = partial(_speed, function)
            title = "Its time beside the reference's (advice)"
            checks.append(Check(function.name, "speed", title, run, "speed", points=0))
    functions = {function.name: function for function in module.functions}
    return ModuleChecks(
        module.name,
        tuple(checks),
        prints={name: prints(module.name, function) for name, function in functions.items()},
        named={name: partial(mistake_of, function) for name, function in functions.items()},
    )


def _check(function: Function, law: Law) -> Check:
    return Check(
        function.name,
        law.name,
        law.title,
        partial(_run, function, law),
        law.kind,
        law.points,
        law.false_fail,
        role=law.role,
    )


def _run(function: Function, law: Law, trial: Trial) -> None:
    """Look whether a law holds; what shows that it doesn't comes with the smallest input that does."""
    try:
        law.run(function, trial)
    except Failure as failure:
        failure.example = failure.example or fewest_columns(function, trial, law)
        raise
    except StudentError as error:
        if error.kind in ("raised", "bad value") and not error.module_wide:
            error.example = fewest_columns(function, trial, law) or error.example
        raise


def _speed(function: Function, trial: Trial) -> None:
    a = function.make(Draw(trial.rng, function.speed, np.float32))
    if trial.yardstick is None:
        # Nothing to compare with; but what gives no value has not passed.
        trial.call(*a.values())
        return
    times: tuple[list[float], list[float]] = ([], [])
    for _ in range(ROUNDS):
        for caller, kept in zip((trial.caller, trial.yardstick), times, strict=True):
            started = perf_counter()
            caller.call(function.name, *a.values())
            kept.append(perf_counter() - started)
    yours, reference = min(times[0]), min(times[1])
    if yours > SLOW * reference:
        trial.notes.append(
            f"It takes {yours / reference:.0f} times as long as the reference ({yours * 1e3:.0f} ms for "
            f"{function.speed} columns): whole arrays instead of loops would help."
        )
