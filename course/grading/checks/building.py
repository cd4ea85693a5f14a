"""From declarations to checks: those of the conventions, a check for each law, and one of the time it takes."""

from __future__ import annotations

import zipfile
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import partial
from io import BytesIO
from itertools import count
from time import perf_counter
from typing import Any
from unittest.mock import patch

import numpy as np

from course.grading.checks.check import Array, Caller, Check, Failure, ModuleChecks, Trial
from course.grading.checks.conventions import conventions
from course.grading.checks.declare import Function, Law, Module
from course.grading.checks.drawing import Draw
from course.grading.checks.examples import fewest_columns
from course.grading.checks.mistakes import Misconception, matching, taken
from course.grading.checks.slips import SLIPS
from course.grading.errors import StudentError
from course.grading.known import Known, known, trusted

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
        prints={name: _prints(module.name, function) for name, function in functions.items()},
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


# ---------------------------------------------------------------- mistakes


def _prints(module: str, function: Function) -> Check:
    def prepare(caller: Caller, _: np.random.Generator) -> dict[str, Array]:
        found = {f"/{key}": value for key, value in taken(function, caller).items()}
        for one in known(module):
            if one.mistake not in ("", *SLIPS) and one.function == function.name:
                found |= _print(function, one)
        # One array of all: a file of thousands of small ones takes seconds to open.
        return {"packed": np.frombuffer(_packed(found), np.uint8).copy()}

    return Check(function.name, "mistakes", "", lambda _: None, points=0, prepare=prepare)


def _packed(arrays: Mapping[str, Array]) -> bytes:
    """A file as ``np.savez_compressed`` makes it, but for the time of day: the same arrays give the same bytes."""
    file = BytesIO()
    with zipfile.ZipFile(file, "w") as pack:
        for name, array in arrays.items():
            entry = zipfile.ZipInfo(f"{name}.npy")
            entry.compress_type = zipfile.ZIP_DEFLATED
            with pack.open(entry, "w") as member:
                np.lib.format.write_array(member, array, allow_pickle=False)
    return file.getvalue()


def _print(function: Function, one: Known) -> dict[str, Array]:
    # Some draw numbers of their own: other ones in each call, but the same course gives the same bytes.
    draw, seeds = np.random.default_rng, count()
    seeded = patch(
        "numpy.random.default_rng", lambda seed=None: draw(next(seeds) if seed is None else seed)
    )
    np.random.seed(0)  # noqa: NPY002
    with np.errstate(all="ignore"), seeded:
        arrays = taken(function, trusted(one))
    start = f"{one.mistake}~{one.name}"
    return {f"{start}/{key}": value for key, value in arrays.items()} | {
        f"{start}/says": np.array(one.says)
    }


def mistake_of(
    function: Function, caller: Caller, prints: Mapping[str, Array]
) -> tuple[str, str] | None:
    """Which known mistake somebody's function makes, and what the student is told; None for none.

    Parameters
    ----------
    prints : as `Check.prepare` of ``ModuleChecks.prints`` made them; without any, nothing is known
    """
    if not prints:
        return None
    grouped: dict[str, dict[str, Any]] = {}
    with np.load(BytesIO(prints["packed"].tobytes()), allow_pickle=False) as arrays:
        for name in arrays.files:
            start, _, key = name.partition("/")
            grouped.setdefault(start, {})[key] = arrays[name]
    right = grouped.pop("", {})
    found = matching(function, caller, _misconceptions(grouped), right)
    return (found.name, found.says) if found else None


def _misconceptions(grouped: Mapping[str, Mapping[str, Any]]) -> Iterable[Misconception]:
    says: dict[str, str] = {}
    for start, arrays in grouped.items():
        name = start.partition("~")[0]
        says[name] = says.get(name) or str(arrays["says"])
    for start, arrays in grouped.items():
        name = start.partition("~")[0]
        yield Misconception(name, says[name], arrays)
