"""Run the checks of a module on somebody's functions.

One result for each check, whatever happens: a mistake costs the checks that it concerns. An exception in a check itself
is the grader's error, with its points given, if it breaks with the reference in the student's place as well; else it
has broken on what the student's function gave, and counts as failed. A function that has run out of time once, or isn't
written yet, is not called again. What has been said of a function before is not said again: its later results name the
first.
"""

import traceback
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import cache, partial
from time import perf_counter
from typing import Any

import numpy as np

from course.school.grading.checks.check import (
    Array,
    Caller,
    Check,
    Failure,
    ModuleChecks,
    References,
    Trial,
    generator,
)
from course.school.grading.checks.closer import CloserLook
from course.school.grading.checks.declare import declaration, unstacked
from course.school.grading.checks.lending import Lending, Outcome, Substitutes
from course.school.grading.checks.mistakes import SLIPS
from course.school.grading.checks.remedies import column_of, of_count, of_no_use, of_shape
from course.school.grading.checks.result import (
    NOT_WRITTEN,
    Result,
    Status,
    broken,
    result_of,
    troubled,
)
from course.school.grading.errors import StudentError
from course.school.grading.looked import Looked
from course.school.grading.worker.limits import NOT_RUN
from course.school.grading.worker.wording import said, told

Standard = Callable[[], Caller]
"""Makes the reference's module."""


def run_checks(
    checks: ModuleChecks,
    caller: Caller,
    references: References,
    seed: int,
    only: Callable[[Check], bool] | None = None,
    reference_caller: Caller | None = None,
    substitutes: Substitutes = lambda _: None,
    standard: Standard | None = None,
) -> Iterator[Result]:
    """Results in the order of the checks, each as soon as it is there.

    Parameters
    ----------
    reference_caller : the reference, to compare times with
    substitutes : who is asked again when a check fails, so that a function pays for no other function's mistake
    standard : the reference in this process, for checks that break; None where there is no solution
    """
    given_up: dict[str, Result] = {}
    by_cause: dict[tuple[str, str], str] = {}
    attempt = partial(_attempt, checks.module, references=references, seed=seed, standard=standard)
    lending = Lending(attempt, caller, reference_caller, substitutes)
    closer = cache(partial(CloserLook, checks, references, seed, partial(Gate, checks.module)))
    for check in filter(only, checks.checks):
        if check.function in given_up:
            # What ran out of time isn't waited for again. A stub earns no checks of arguments, which it came with.
            first = given_up[check.function]
            found = first.found or NOT_WRITTEN
            if first.status is Status.TIMEOUT and not found.startswith(NOT_RUN):
                found = OUT_OF_TIME
            result = result_of(checks.module, check, first.status, found=found)
            yield replace(result, same_as=first.id)
            continue
        started = perf_counter()
        hung = any(first.status is Status.TIMEOUT for first in given_up.values())
        result, error, asked = lending.asked(check, lent_first=hung)
        if result.status in (Status.TIMEOUT, Status.NOT_ATTEMPTED):
            given_up[check.function] = result
        if result.status is Status.FAILED:
            result = closer().at(result, check, asked, alone=substitutes(check.function) is None)
        if error is not None:
            first_id = by_cause.setdefault((check.function, error.cause), result.id)
            if first_id != result.id:
                result = replace(result, same_as=first_id, where="")
        yield replace(result, seconds=perf_counter() - started)


OUT_OF_TIME = "an earlier check of this function ran out of time"


def _attempt(
    module: str,
    check: Check,
    caller: Caller,
    reference_caller: Caller | None,
    *,
    references: References,
    seed: int,
    standard: Standard | None,
) -> Outcome:
    def trial_of(whose: Caller) -> Trial:
        return Trial(
            check.function, whose, generator(seed, module, check), reference_caller=reference_caller
        )

    # It may be that memory or disk were short: once more tells.
    for _ in range(2):
        gate = Gate(module, caller)
        trial = trial_of(gate)
        try:
            return _ended(module, check, trial, references)
        except Exception:  # noqa: BLE001 - what breaks a check must not end the grading of others
            how = traceback.format_exc()
    too = None if standard is None else _breaks(module, check, trial_of, standard, references)
    result = broken(module, check, too, gate.last)
    return replace(result, figures=tuple(trial.figures), instructor=how), None


def _ended(module: str, check: Check, trial: Trial, references: References) -> Outcome:
    """How a check ended; whatever it raises beside is its own fault."""
    trouble: StudentError | None = None
    try:
        # The check's numbers begin where prepare's do.
        trial.references = _prepared(module, check, references)
        check.run(trial)
        result = result_of(module, check, Status.PASSED, hint=" ".join(trial.notes))
    except Failure as failure:
        result = result_of(
            module,
            check,
            Status.FAILED,
            expected=failure.expected,
            found=failure.found,
            where=failure.where,
            hint=failure.hint,
            example=failure.example or check.smallest(trial) or failure.where,
            mistake=failure.slip,
            says=SLIPS.get(failure.slip, ""),
        )
    except StudentError as error:
        if error.kind in ("raised", "bad value") and not error.module_wide:
            error.example = check.smallest(trial) or error.example
        # Its frames hold whatever the function gave, until Python looks for cycles.
        result, trouble = troubled(module, check, error), error.with_traceback(None)
    return replace(result, figures=tuple(trial.figures)), trouble


def _prepared(module: str, check: Check, references: References) -> Mapping[str, Array]:
    try:
        return references(module, check) if check.prepare else {}
    except (Failure, StudentError) as error:
        raise RuntimeError("the check's references can't be made") from error


def _breaks(
    module: str,
    check: Check,
    trial_of: Callable[[Caller], Trial],
    standard: Standard,
    references: References,
) -> bool | None:
    """Whether it breaks with the reference; None where that can't be made."""
    try:
        right = standard()
    except Exception:  # noqa: BLE001 - nobody to compare with
        return None
    try:
        _ended(module, check, trial_of(Gate(module, right)), references)
    except Exception:  # noqa: BLE001 - in whatever way
        return True
    return False


# ---------------------------------------------------------------- the gate


class Gate:
    """A ``Caller`` between a student's functions and a check: it lets no value through that a check could stumble over.

    The kind of each result is looked at, how many there are, their shape where the engine counts on it, and whether
    all numbers are finite. Which dtype they have is the business of the checks of the contract.

    Parameters
    ----------
    module : whose functions are called; those of all modules together are called MODULE.NAME
    caller : calls them
    """

    def __init__(self, module: str, caller: Caller) -> None:
        self._module, self._caller = module, caller
        self._last: tuple[str, Any, tuple[Any, ...], dict[str, Any]] | None = None

    @property
    def last(self) -> str:
        """What the last call gave, and for which arguments."""
        if self._last is None:
            return "nothing was called"
        function, value, arguments, named = self._last
        given = said(self._path(function), arguments, named)
        return f"{function} returned {told(value)} for {given or 'no arguments'}"

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        """The function's value.

        Raises StudentError: there is none, or ("bad value") it is not of the kind that it should be.
        """
        value = self._caller.call(function, *arguments, **named)
        return self._looked(function, value, arguments, named)

    def call_and_look(self, function: str, *arguments: Any) -> Looked:
        """See ``Caller``; raises the same."""
        value, after, changed = self._caller.call_and_look(function, *arguments)
        return self._looked(function, value, arguments, {}), after, changed

    def _path(self, function: str) -> str:
        return function if "." in function else f"{self._module}.{function}"

    def _looked(
        self, function: str, value: Any, arguments: tuple[Any, ...], named: dict[str, Any]
    ) -> Any:
        declared = declaration(*self._path(function).split(".", 1))
        count = len(declared.results) if declared else 0
        value = unstacked(value, count)
        self._last = function, value, arguments, named
        if declared is None:
            return value
        several = isinstance(value, tuple | list)
        parts = value if several else (value,)
        wrong, remedy, example = "", "", ""
        if several != (count > 1) or len(parts) != count:
            wanted = f"{count} results" if count > 1 else "one array or number"
            wrong = f"{told(value)} instead of {wanted}"
            remedy = of_count(value, count)
        else:
            shapes = (None if named else declared.shapes(arguments)) or [None] * count
            for part, result, shape in zip(parts, declared.results, shapes, strict=True):
                if not wrong and (wrong := _wrong(part, shape, not result.endless)):
                    example = column_of(declared, part, arguments)
                    remedy = of_shape(part, shape)
        if wrong:
            given = said(self._path(function), arguments, named)
            raise of_no_use(f"{function} returned {wrong}", given, remedy, example)
        return value


def _wrong(part: Any, shape: tuple[int, ...] | None, finite: bool) -> str:
    """What is wrong with one result; empty if nothing is."""
    if not isinstance(part, np.ndarray | np.generic | bool | int | float):
        return f"{told(part)} instead of numbers"
    array = np.asarray(part)
    if array.dtype.kind not in "fiub":
        return f"an array of {array.dtype} instead of numbers"
    if shape and (array.shape != shape or not isinstance(part, np.ndarray)):
        return f"{told(part)} instead of an array of shape {shape}"
    if not finite or np.isfinite(array).all():
        return ""
    index = tuple(map(int, np.argwhere(~np.isfinite(array))[0]))
    return f"numbers that are not finite: {array[index]}" + (f" at index {index}" if index else "")
