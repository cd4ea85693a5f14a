"""The kill matrix: every known wrong submission fails at the check meant for it, every right one earns full marks."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from course.effects import COURSE
from course.grading.catalog import module_checks
from course.grading.checks.check import Caller, Check
from course.grading.checks.preparing import References
from course.grading.checks.result import Result, Status
from course.grading.checks.running import run_checks
from course.grading.known import Known

WIDTH = max(map(len, COURSE)) + 2
"""Characters of the matrix's column of modules."""


@dataclass(frozen=True)
class Verdict:
    """What became of one known submission.

    Attributes
    ----------
    submission : which
    failed : checks that it failed, "point_on_disk/uniform"
    told : the mistake that the student was told at the check meant for it
    fault : what is wrong with the grader; empty if nothing is
    """

    submission: Known
    failed: tuple[str, ...]
    told: str
    fault: str


def judge(
    submission: Known,
    caller: Caller,
    references: References,
    seed: int,
    only: Callable[[Check], bool] | None = None,
) -> Verdict:
    """Run all checks on a known submission and see whether they say what they should."""
    results = list(run_checks(module_checks(submission.module), caller, references, seed, only))
    wrong = [result for result in results if result.status is not Status.PASSED]
    failed = tuple(f"{result.function}/{result.check}" for result in wrong)
    meant = [
        result
        for result in wrong
        if result.function == submission.function and result.check == submission.caught_by
    ]
    told = meant[0].mistake if meant else ""
    return Verdict(submission, failed, told, _fault(submission, wrong, meant))


def _fault(submission: Known, wrong: list[Result], meant: list[Result]) -> str:
    broken = [result for result in wrong if result.status is Status.GRADER_ERROR]
    if broken:
        return f"the grader's own error in {broken[0].id}: {broken[0].found}"
    if submission.right:
        return f"right, but fails {wrong[0].id}: {wrong[0].found}" if wrong else ""
    if not meant:
        return f"passes {submission.function}/{submission.caught_by}, which is meant for it"
    if submission.mistake and meant[0].mistake != submission.mistake:
        return f"is told {meant[0].mistake or 'nothing'!r} instead of {submission.mistake!r}"
    return ""


def matrix(verdicts: Iterable[Verdict]) -> list[str]:
    """Lines of the matrix: a submission each, the checks that it fails, the mistake that it is told."""
    lines = []
    indent = " " * (6 + WIDTH + 6)
    for verdict in verdicts:
        known = verdict.submission
        kind = "right" if known.right else "wrong"
        mark = "FAULT" if verdict.fault else "ok"
        lines.append(
            f"{mark:<6}{known.module:<{WIDTH}}{kind:<6}{known.name:<30}{', '.join(verdict.failed) or '-'}"
        )
        if verdict.told:
            lines.append(f"{indent}told: {verdict.told}")
        if verdict.fault:
            lines.append(f"{indent}{verdict.fault}")
    return lines
