"""The grader's own test: wrong submissions fail where they should, right ones nowhere.

In this process and without the checks that take many pictures, a wrong one by few checks. Of wrong ones that are meant
for the same check the first is tried: each check is seen to fail. Of modules whose checks take seconds one of each kind
of check is, and of right ones beside the first of a module a share; `make stress` tries them all. `make mutants` runs
all checks on all submissions, in workers.
"""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from benchmarks.mutants.judging import Verdict, judge, marks, matrix, unfair
from course.engine.functions.modules import COURSE
from course.school.grading.calibration import trusted
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Check, References
from course.school.grading.checks.result import Result, Status
from course.school.grading.known import KnownSubmission, known
from course.school.grading.references import reference
from tests.lengths import LONG, share

ALL = [submission for module in COURSE for submission in known(module)]

SLOW = ("columns", "loops")
"""Right submissions that take rays one by one: only the first properties of each function are asked of them."""

DEAR = ("bounding_volumes", "denoising", "many_lights", "media")
"""Modules whose properties take seconds: so few of them are asked of right submissions."""

FEW = 2

SEEN = {one.module: one.name for one in ALL if one.right and one.name not in SLOW}
"""A right submission of each module of which pictures are taken and distributions drawn, too. Others return the same
values to the last digits, so these tell no more of them; of those that take rays one by one they take a minute."""

KINDS = {
    (module, check.function, check.name): check.kind
    for module in COURSE
    for check in module_checks(module).checks
}


def meant_for(one: KnownSubmission) -> tuple[str, str, str]:
    """What one of the wrong submissions that are alike in it is tried for: a check, or a kind of checks."""
    check = one.module, one.function, one.caught_by
    return (*check[:2], KINDS[check]) if one.module in DEAR and not LONG else check


FIRST = {meant_for(one): one for one in reversed(ALL) if not one.right}
RIGHT = [one for one in ALL if one.right and one.name == SEEN[one.module]]
RIGHT += share([one for one in ALL if one.right and one not in RIGHT], 4)
TRIED = [*RIGHT, *reversed(FIRST.values())]


def quick(check: Check) -> bool:
    return check.kind not in ("bias", "speed")


@cache
def first_properties(module: str) -> set[tuple[str, str]]:
    """Function and name of the first properties of each function."""
    found: dict[str, list[str]] = {function: [] for function in COURSE[module]}
    for check in module_checks(module).checks:
        if check.kind == "property" and len(found[check.function]) < FEW:
            found[check.function].append(check.name)
    return {(function, name) for function, names in found.items() for name in names}


def concerned(submission: KnownSubmission, called_before: bool) -> Callable[[Check], bool]:
    """All checks for a right submission; for a wrong one the check meant for it, after one that calls the function or
    alone.
    """
    if submission.right:
        seen = submission.name == SEEN[submission.module]
        dear = submission.module in DEAR and not (seen and LONG)
        few = first_properties(submission.module) if submission.name in SLOW or dear else None
        return lambda check: (
            check.kind == "contract"
            or (check.kind == "property" and (few is None or (check.function, check.name) in few))
            or (check.kind != "property" and seen and quick(check))
        )
    names = ("contract", submission.caught_by) if called_before else (submission.caught_by,)
    return lambda check: check.function == submission.function and check.name in names


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("submission", TRIED, ids=[f"{k.module}-{k.name}" for k in TRIED])
def test_the_grader_says_what_it_should(
    submission: KnownSubmission, usual_references: References
) -> None:
    # Some mistakes are made from the second call on: then the check may pass that is the first to call the function.
    for called_before in (True,) if LONG or submission.right else (False, True):
        only = concerned(submission, called_before)
        verdict = judge(submission, trusted(submission), usual_references, 0, only)
        if not verdict.fault:
            break
    assert not verdict.fault, "\n".join(matrix([verdict]))


@pytest.mark.parametrize("module", COURSE)
def test_there_are_enough_of_them(module: str) -> None:
    found = known(module)
    assert sum(submission.right for submission in found) >= 3
    assert sum(not submission.right for submission in found) >= 5
    # Each function has a submission that gets it wrong.
    assert {submission.function for submission in found if not submission.right} == set(
        COURSE[module]
    )
    wrong = [(s.function, s.about) for s in found if not s.right]
    assert len(set(wrong)) == len(wrong)


def test_columns_of_the_matrix_stand_apart_and_below_each_other() -> None:
    lines = matrix(Verdict(one, (f"{one.function}/contract",), "its-mistake", "") for one in ALL)
    rows = lines[::2]
    assert [line.split() for line in rows] == [
        ["ok", one.module, "right" if one.right else "wrong", one.name, f"{one.function}/contract"]
        for one in ALL
    ]
    columns = {
        (line.index(one.module), line.index(" right " if one.right else " wrong "))
        for line, one in zip(rows, ALL, strict=True)
    }
    assert len(columns) == 1
    names = {line.index(f" {one.name} ") for line, one in zip(rows, ALL, strict=True)}
    assert {len(told) - len(told.lstrip()) for told in lines[1::2]} == {n + 1 for n in names}


def test_a_grader_that_lets_everything_pass_is_found_out(usual_references: References) -> None:
    wrong = next(submission for submission in ALL if not submission.right)
    verdict = judge(wrong, reference(wrong.module), usual_references, 0, quick)
    assert "meant for it" in verdict.fault


@pytest.mark.parametrize(
    ("name", "earned", "says"),
    [
        ("one_added", 0, "is wrong in a corner only, but earns 0% of its points"),
        ("one_added", 1, ""),
        ("one_squared", 1, "is of no use, but earns 100% of its points"),
        ("one_squared", 0, ""),
    ],
)
def test_points_that_are_not_fair_are_found_out(name: str, earned: int, says: str) -> None:
    wrong = next(one for one in known("multiple_importance") if one.name == name)
    status = Status.PASSED if earned else Status.FAILED
    result = Result(wrong.module, wrong.function, "values", "", "whole", status, earned, 1)
    assert unfair(marks(Verdict(wrong, (), "", "", (result,)))) == says


def test_a_grader_that_fails_the_right_is_found_out(usual_references: References) -> None:
    right = next(submission for submission in ALL if submission.right)

    class Wrong:
        def call(self, *_: object, **__: object) -> object:
            return np.zeros(3)

        def call_and_look(self, _: str, *given: object) -> tuple[object, list[object], bool]:
            return np.zeros(3), list(given), False

    verdict = judge(right, Wrong(), usual_references, 0, quick)
    assert verdict.fault.startswith(("right, but fails", "the grader's own error"))
