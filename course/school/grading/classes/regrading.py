"""Grade a class again after a change to the grader, and tell who changes by what before anything is written.

New results lie in a folder of their own until they are applied. They are kept there for as long as the grader's code
stays the same, so that applying what was looked at takes no second grading, and an interrupted run goes on.
"""

import hashlib
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from course.engine.functions.effects import PACKAGE, PROJECT
from course.school.grading.checks.result import Result
from course.school.grading.classes.grading import (
    FAULT,
    ClassResult,
    Finished,
    Runner,
    finish,
    grade_all,
)
from course.school.grading.classes.keeping import fingerprint, keep, kept, kept_files, recorded
from course.school.grading.classes.settings import INSTRUCTOR, GradingSettings
from course.school.grading.classes.submitted import find_submissions
from course.school.grading.report import Report

_CODE = ((PACKAGE, "*.py"), (PACKAGE, "*.json"), (PROJECT / "solutions", "*.py"))


@dataclass(frozen=True)
class ScoreChange:
    """The changes of a new grading for a student.

    Attributes
    ----------
    student : str
    before : the report that stands; None if there is none
    after : the new one
    checks : pairs of results, before and after, of the checks that end in another way; None for one that isn't there
    """

    student: str
    before: Report | None
    after: Report
    checks: tuple[tuple[Result | None, Result | None], ...]


@dataclass(frozen=True)
class Regraded:
    """A class graded again, and not yet applied.

    Attributes
    ----------
    result : of the new grading
    changes : of those who change
    settings : with which it was graded
    gone : students who have been graded before, and have no submission now
    """

    result: ClassResult
    changes: tuple[ScoreChange, ...]
    settings: GradingSettings
    gone: tuple[str, ...] = ()


def regrade(folder: Path, out: Path, settings: GradingSettings, runner: Runner) -> Regraded:
    """Grade a class again, beside what was graded before.

    Parameters
    ----------
    folder, out : as for `grade_class`
    settings : of the grading before, with what is to change
    """
    runner.check(folder, out)
    submissions = find_submissions(folder, settings.modules)
    before = {one.student: kept(out, one.student) for one in submissions}
    result = grade_all(submissions, _staging(out), settings, runner, _code())
    changes = (_change(before[report.student], report) for report in result.reports)
    gone = tuple(student for student in recorded(out) if student not in before)
    return Regraded(result, tuple(one for one in changes if one is not None), settings, gone)


def apply(regraded: Regraded, out: Path) -> Finished:
    """Put the new results in the place of those before; where the grader failed, what was there stays."""
    result, settings = regraded.result, regraded.settings
    terms = settings.read()
    reports = []
    for one, report in zip(result.submissions, result.reports, strict=True):
        if report.trouble.startswith(FAULT):
            reports.append(kept(out, one.student) or report)
            continue
        mark = "" if report.broken else fingerprint(one, settings)
        keep(out, kept_files(_staging(out), report), mark)
        reports.append(report)
    finished = finish(result.submissions, reports, out, settings, terms)
    settings.write(out)
    shutil.rmtree(_staging(out), ignore_errors=True)
    return finished


def _change(before: Report | None, after: Report) -> ScoreChange | None:
    if after.trouble.startswith(FAULT):
        return None
    pairs = _paired(before.results if before else (), after.results)
    checks = tuple(pair for pair in pairs if _ended(pair[0]) != _ended(pair[1]))
    same = before is not None and before.trouble == after.trouble
    return None if same and not checks else ScoreChange(after.student, before, after, checks)


def _paired(
    before: Sequence[Result], after: Sequence[Result]
) -> list[tuple[Result | None, Result | None]]:
    """Results of the same check, those that are gone last."""
    old = {result.id: result for result in before}
    new = {result.id for result in after}
    gone: list[tuple[Result | None, Result | None]] = [
        (result, None) for result in before if result.id not in new
    ]
    return [*((old.get(result.id), result) for result in after), *gone]


def _ended(result: Result | None) -> tuple[object, ...]:
    return () if result is None else (result.status, round(result.points, 6), round(result.of, 6))


def _staging(out: Path) -> Path:
    return out / INSTRUCTOR / "regraded"


def _code() -> str:
    """A hash that changes whenever the grader's own code, its data or a solution does."""
    found = hashlib.sha256()
    for folder, pattern in _CODE:
        for path in sorted(folder.rglob(pattern)):
            found.update(f"{path.relative_to(folder)}\0".encode() + path.read_bytes() + b"\0")
    return found.hexdigest()
