"""Run the checks of a module on somebody's functions.

One result for each check, whatever happens: a mistake costs the checks that it concerns, and an exception in a check
itself is the grader's error, with its points given. A function that has run out of time once, or isn't written yet, is
not called again. What has been said of a function before is not said again: its later results name the first.
"""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from time import perf_counter

from course.grading.checks.check import Caller, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.preparing import References, generator, named_generator
from course.grading.checks.result import NOT_WRITTEN, Result, Status, result_of, troubled
from course.grading.errors import StudentError
from course.grading.worker.patience import NOT_RUN

Lenders = Callable[[str], Caller | None]
"""function -> the same student's module, with the reference's in place of the functions that come before it."""


def run_checks(
    checks: ModuleChecks,
    caller: Caller,
    references: References,
    seed: int,
    only: Callable[[Check], bool] | None = None,
    yardstick: Caller | None = None,
    lenders: Lenders = lambda _: None,
) -> Iterator[Result]:
    """Results in the order of the checks, each as soon as it is there.

    Parameters
    ----------
    yardstick : the reference, to compare times with
    lenders : who is asked again when a check fails, so that a function pays for no other function's mistake
    """
    given_up: dict[str, Result] = {}
    matched: dict[str, Mistake | None] = {}
    told: dict[tuple[str, str], str] = {}
    attempt = partial(_attempt, checks.module, references=references, seed=seed)
    for check in checks.checks:
        if only is not None and not only(check):
            continue
        if check.function in given_up:
            # What ran out of time isn't waited for again; and a stub must not earn the checks of its arguments, which
            # it came with.
            first = given_up[check.function]
            found = first.found or NOT_WRITTEN
            if first.status is Status.TIMEOUT and not found.startswith(NOT_RUN):
                found = OUT_OF_TIME
            result = result_of(checks.module, check, first.status, found=found)
            yield replace(result, same_as=first.id)
            continue
        started = perf_counter()
        hung = any(first.status is Status.TIMEOUT for first in given_up.values())
        result, error, asked = _asked(attempt, check, caller, yardstick, lenders, lent_first=hung)
        if result.status in (Status.TIMEOUT, Status.NOT_ATTEMPTED):
            given_up[check.function] = result
        if result.status is Status.FAILED:
            if check.function not in matched:
                matched[check.function] = _matching(checks, check.function, asked, seed)
            mistake = matched[check.function]
            if mistake is not None:
                result = replace(result, mistake=mistake.name, says=mistake.says)
        if error is not None:
            first_id = told.setdefault((check.function, error.cause), result.id)
            if first_id != result.id:
                result = replace(result, same_as=first_id, where="")
        yield replace(result, seconds=perf_counter() - started)


def unusable(
    checks: ModuleChecks, error: StudentError, only: Callable[[Check], bool] | None = None
) -> Iterator[Result]:
    """Results where no function of the module can be called: none passes, and the first says why in full."""
    first = ""
    for check in checks.checks:
        if only is None or only(check):
            result = replace(troubled(checks.module, check, error), expected="", module_wide=True)
            yield replace(result, where="", same_as=first) if first else result
            first = first or result.id


STANDS_ON = "Right by itself: the check passes when the functions above it, which this one calls, are the course's own."

OUT_OF_TIME = "an earlier check of this function ran out of time"

_Outcome = tuple[Result, StudentError | None]


def _asked(
    attempt: Callable[..., _Outcome],
    check: Check,
    caller: Caller,
    yardstick: Caller | None,
    lenders: Lenders,
    *,
    lent_first: bool,
) -> tuple[Result, StudentError | None, Caller]:
    """A check with the student's functions alone, and with the reference's above it if it doesn't pass so.

    Parameters
    ----------
    lent_first : the other way round, because a function above it never ends: whoever calls that one would be waited
        for in vain

    Returns
    -------
    what it gave, the error where there was one, and with which functions
    """
    lender = lenders(check.function) if lent_first else None
    lent: _Outcome | None = None
    if lender is not None:
        lent = attempt(check, lender, yardstick=None)
        if lent[0].status is Status.PASSED:
            return replace(lent[0], hint=STANDS_ON), None, lender
    result, error = attempt(check, caller, yardstick=yardstick)
    # What isn't in the file, or is in a file that can't be used, is nobody else's mistake.
    alone = error is not None and (error.kind == "missing" or error.module_wide)
    if result.status in (Status.PASSED, Status.GRADER_ERROR) or alone:
        return result, error, caller
    if lent is None:
        lender = lenders(check.function)
        if lender is not None:
            lent = attempt(check, lender, yardstick=None)
            if lent[0].status is Status.PASSED:
                return replace(lent[0], hint=STANDS_ON), None, lender
    elif lender is not None and result.status is Status.TIMEOUT:
        # It may have waited for the function that never ends; what is wrong with it itself says more.
        return *lent, lender
    return result, error, caller


def _attempt(
    module: str,
    check: Check,
    caller: Caller,
    *,
    references: References,
    seed: int,
    yardstick: Caller | None,
) -> _Outcome:
    trouble: StudentError | None = None
    trial = Trial(check.function, caller, generator(seed, module, check))
    trial.yardstick = yardstick
    try:
        # The check's numbers begin where prepare's do.
        trial.references = references(module, check)
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
        )
    except StudentError as error:
        result, trouble = troubled(module, check, error), error
    except Exception as error:  # noqa: BLE001 - the grader's own fault must not end the grading of others
        result = result_of(
            module,
            check,
            Status.GRADER_ERROR,
            found=f"{type(error).__name__}: {error}",
            where=traceback.format_exc(limit=-3),
            hint="This is no fault of yours; please pass it on.",
        )
    return replace(result, figures=tuple(trial.figures)), trouble


def _matching(checks: ModuleChecks, function: str, caller: Caller, seed: int) -> Mistake | None:
    for mistake in checks.mistakes:
        if mistake.function == function:
            trial = Trial(function, caller, named_generator(seed, mistake.name))
            try:
                if mistake.matches(trial):
                    return mistake
            except StudentError as error:
                if error.kind == "timeout":
                    return None  # The next one would be waited for too.
            except Exception:  # noqa: BLE001 - what comes back is too wrong to be this mistake
                continue
    return None
