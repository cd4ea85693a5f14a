"""What is made of the reports of a class once all are there: tables of grades, and the instructor's page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path

from course.grading.classes.comparing import Compared, compare
from course.grading.classes.keeping import INSTRUCTOR
from course.grading.classes.marks import Mark, mark
from course.grading.classes.policy_file import MODIFIED, Rules, read_policy
from course.grading.classes.roster import Listed, Matched, match, read_roster
from course.grading.classes.submitted import Submission
from course.grading.report import Report

TOTAL = 100.0
"""Of the score where no policy says another."""

CANVAS, MOODLE = "canvas.csv", "moodle.csv"

NOT_CERTAIN = "not_protected_"
"""Before the names of tables for learning systems in which a grade may be forged. Canvas makes an assignment of every
column that it doesn't know, Moodle refuses such a table or asks for a meaning, and any line is a student's: so only the
name can say it."""


@dataclass(frozen=True)
class Terms:
    """What makes grades of points.

    Attributes
    ----------
    policy, roster : files, if there are any
    title : of the assignment, as a learning system knows it
    """

    policy: Path | None = None
    roster: Path | None = None
    title: str = "Penumbra"

    def read(self, modules: Sequence[str]) -> tuple[Rules | None, list[Listed] | None]:
        """The files' contents; raises ``CourseError`` where one can't be read or is wrong."""
        return (
            read_policy(self.policy, modules) if self.policy else None,
            read_roster(self.roster) if self.roster else None,
        )


@dataclass(frozen=True)
class Finished:
    """What came of a class as a whole.

    Attributes
    ----------
    compared : which submissions are alike
    matched : whose submission is whose; None without a roster
    unused : students of the policy who have handed in nothing
    files : tables that were written
    unprotected : why no grade is certain of students whose code nothing kept from doing harm; empty if there are none
    """

    compared: Compared = field(default_factory=Compared)
    matched: Matched | None = None
    unused: tuple[str, ...] = ()
    files: tuple[Path, ...] = ()
    unprotected: str = ""


def finish(
    submissions: Sequence[Submission],
    reports: Sequence[Report],
    out: Path,
    modules: Sequence[str],
    rules: Rules | None = None,
    roster: Sequence[Listed] | None = None,
    title: str = Terms.title,
) -> Finished:
    """Write grades.csv, class.html, and with a roster canvas.csv and moodle.csv.

    The names of the last two begin with ``NOT_CERTAIN`` where a submission was graded without protection.

    Parameters
    ----------
    submissions, reports : in the same order
    title : of the assignment, as a learning system knows it
    """
    from course.grading.reports.classes import Line, write_class_page, write_grades

    (out / INSTRUCTOR).mkdir(parents=True, exist_ok=True)
    compared = compare(submissions, modules, out / INSTRUCTOR / "similarity.npz")
    marks = _marks(submissions, reports, rules)
    lines = {one.student: Line(one.remarks, marks.get(one.student)) for one in submissions}
    total = None if rules is None else rules.policy.total
    matched = None
    if roster is not None:
        matched = match(roster, {one.student: one.names for one in submissions})
    write_grades(reports, out / "grades.csv", lines, total)
    pairs = [(pair.first, pair.second, pair.module, pair.share) for pair in compared.similar]
    write_class_page(
        reports,
        pairs,
        out / "class.html",
        lines,
        total,
        not_compared=compared.left_out,
        matched=matched,
    )
    files = [out / "grades.csv", out / "class.html"]
    files += _write_for_systems(out, reports, marks, total, matched, title)
    return Finished(
        compared, matched, _unused(submissions, rules), tuple(files), _unprotected(reports)
    )


def _unprotected(reports: Sequence[Report]) -> str:
    """The harm that code could have done, and how many submissions' code; empty for none."""
    told = [report.unprotected for report in reports if report.unprotected]
    return f"{told[0]} ({len(told)} of {len(reports)} graded so)" if told else ""


def _marks(
    submissions: Sequence[Submission], reports: Sequence[Report], rules: Rules | None
) -> dict[str, Mark]:
    if rules is None:
        return {}
    by_file = rules.policy.times == MODIFIED
    found = {
        one.student: mark(report, rules, one.names, _modified(one) if by_file else None)
        for one, report in zip(submissions, reports, strict=True)
    }
    return {student: score for student, score in found.items() if score is not None}


def _modified(submission: Submission) -> datetime | None:
    """When the newest file of a submission was written."""
    times = []
    for path in submission.paths:
        for file in [path, *(path.rglob("*") if path.is_dir() else ())]:
            try:
                if not file.is_dir():
                    times.append(file.lstat().st_mtime)
            except OSError:
                continue
    return datetime.fromtimestamp(max(times), UTC) if times else None


def _write_for_systems(
    out: Path,
    reports: Sequence[Report],
    marks: dict[str, Mark],
    total: float | None,
    matched: Matched | None,
    title: str,
) -> list[Path]:
    """Write what learning systems import; tables of an earlier run are not left behind."""
    from course.grading.reports.classes import write_canvas, write_moodle

    for name in (CANVAS, MOODLE):
        for path in (out / name, out / f"{NOT_CERTAIN}{name}"):
            path.unlink(missing_ok=True)
    if matched is None:
        return []
    before = NOT_CERTAIN if _unprotected(reports) else ""
    canvas, moodle = out / f"{before}{CANVAS}", out / f"{before}{MOODLE}"
    grades = [
        (
            matched.students[report.student],
            marks[report.student].final if total is not None else TOTAL * report.score,
        )
        for report in reports
        if report.student in matched.students and not report.trouble
    ]
    write_canvas(grades, TOTAL if total is None else total, title, canvas)
    write_moodle(grades, title, moodle)
    return [canvas, moodle]


def _unused(submissions: Sequence[Submission], rules: Rules | None) -> tuple[str, ...]:
    if rules is None:
        return ()
    used = {rules.student(one.names)[0] for one in submissions}
    return tuple(name for name in rules.policy.students if name not in used)
