"""The whole class: tables of grades for a spreadsheet, Canvas and Moodle, and one page for the instructor."""

import csv
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from itertools import groupby
from operator import attrgetter
from pathlib import Path
from statistics import fmean, median
from types import MappingProxyType
from typing import Any
from urllib.parse import quote

from course.base.atomic import write_text
from course.base.texts import clean
from course.school.grading.checks.result import Result, Status
from course.school.grading.classes.policy import Mark
from course.school.grading.classes.roster import Listed, Matched, Roster
from course.school.grading.report import FunctionResults, Report, ending, grouped
from course.school.grading.reports.formats import finite
from course.school.grading.reports.insight import changes, misconceptions, without_name
from course.school.grading.reports.page import render

MARKS = ("raw", "adjusted", "final")
"""Columns of the score by a policy."""

BARS = 10
"""Of the histogram of scores."""

PAIRS = 200
"""Submissions that are alike are listed up to this many pairs, the most alike first."""

MOST = 3
"""Misconceptions that are named before all others, whichever module they are of."""

_BAR_HEIGHT = 165
_LONG = 20
"""Rows of a table beyond which it, or the rest of it, is folded."""

_MANY = 60
"""Likewise of the table of students."""

_NOT_FAILED = (Status.PASSED, Status.NOT_ATTEMPTED, Status.GRADER_ERROR)

_FORMULA = tuple("=+-@\t\r\n\uff1d\uff0b\uff0d\uff20")
"""What makes a spreadsheet take a text for a formula: the four signs, full-width ones too, and blanks before them."""

SYSTEMS: Mapping[str, Mapping[str, tuple[str, ...]]] = {
    "canvas.csv": dict.fromkeys(("Student", "ID", "SIS User ID", "SIS Login ID", "Section"), ()),
    "moodle.csv": {
        "Identifier": (),
        "Full name": (),
        "Username": ("login", "sis login id", "netid"),
        "ID number": ("idnumber", "student id", "sis user id"),
        "Email address": ("email", "e-mail"),
    },
}
"""Table of a learning system -> its columns -> columns of a roster that say the same where it has none of that name."""


_PASSED_OVER = re.compile(r"\b(?:current|final|override|unposted)\b", re.IGNORECASE)
"""What headings of Canvas's own totals begin with: `Final Score`, `Override Grade`."""


@dataclass(frozen=True)
class ClassLine:
    """Remarks and mark of a student, besides what was found.

    Attributes
    ----------
    remarks : what was guessed of the submission, and what of it was left out
    mark : the score by the policy; None where there is no policy, or no grade
    """

    remarks: tuple[str, ...] = ()
    mark: Mark | None = None


def write_grades(
    reports: Sequence[Report],
    path: Path,
    lines: Mapping[str, ClassLine] = MappingProxyType({}),
    total: float | None = None,
) -> None:
    """Write grades.csv: student, score, points, of, which checks broke, remarks, then the points of each function.

    A submission that could not be graded has no numbers: a 0 would look like a grade.
    Raises OutputError: the file can't be written.

    Parameters
    ----------
    lines : student -> what else there is to say
    total : score of who has earned all; with it come the columns raw, adjusted and final
    """
    points = [
        {
            f"{function.module}.{function.name}": function.points
            for module in grouped(report)
            for function in module.functions
        }
        for report in reports
    ]
    functions = [*dict.fromkeys(name for own in points for name in own)]
    head = ["student", "score", "points", "of", *([] if total is None else MARKS)]
    rows = [[*head, "broken checks", "remarks", *map(safe_cell, functions)]]
    for report, own in zip(reports, points, strict=True):
        line = lines.get(report.student, ClassLine())
        score = line.mark or Mark(0.0, 0.0, 0.0)
        grades = [report.score, report.points, report.of]
        grades += [] if total is None else [score.raw, score.adjusted, score.final]
        remarks = (report.unprotected, report.trouble, *score.why, *line.remarks)
        rows.append(
            [
                safe_cell(report.student),
                *("" if report.trouble else _number(grade) for grade in grades),
                safe_cell(" ".join(result.id for result in report.broken)),
                safe_cell("; ".join(filter(None, remarks))),
                *(_number(own[name]) if name in own else "" for name in functions),
            ]
        )
    _write_table(rows, path)


def write_gradebook(
    system: str,
    roster: Roster,
    grades: Iterable[tuple[Listed, float]],
    total: float,
    title: str,
    path: Path,
) -> None:
    """Write what Canvas imports into its gradebook, or Moodle, also as an upload of a grading worksheet.

    A roster that isn't Canvas's goes to Moodle with its own headings and cells, as they came: a worksheet in whatever
    language with its grades filled in, any other list with a column more.
    Raises OutputError: the file can't be written.

    Parameters
    ----------
    system : of ``SYSTEMS``
    total : points of who has earned all
    title : the assignment as the system calls it, such as "Lens (12345)"; on Canvas a new name makes a new assignment
    """
    if system == "moodle.csv" and not roster.is_canvas:
        _write_table(_own_rows(roster, grades, total, title), path)
        return
    columns = SYSTEMS[system]
    rows = [[*columns, clean(title)]]
    if "Student" in columns:
        rows.append(["    Points Possible", "", "", "", "", _number(total)])
    for listed, grade in grades:
        # The roster is the system's own, so no text is changed that it knows by.
        own = {name: listed.get(name.casefold(), *others) for name, others in columns.items()}
        for name in {"Student", "Full name"} & own.keys():
            own[name] = own[name] or listed.name
        rows.append([*map(clean, own.values()), _number(grade)])
    _write_table(rows, path)


def _own_rows(
    roster: Roster, grades: Iterable[tuple[Listed, float]], total: float, title: str
) -> Iterator[list[str]]:
    """The roster's own table of those who have a grade."""
    sheet = roster.worksheet
    yield [*map(clean, roster.columns), *([] if sheet else [clean(title)])]
    for listed, grade in grades:
        cells = [*map(clean, listed.cells)]
        if sheet is None:
            yield [*cells, _number(grade)]
            continue
        number = _number(grade if sheet.most is None else grade * sheet.most / total)
        cells[sheet.grade] = number.replace(".", ",") if sheet.comma else number
        yield cells


def doubts_of(roster: Roster, title: str, total: float) -> Iterator[str]:
    """What is told of tables for learning systems: what they pass over, and what was made of the grades."""
    if _PASSED_OVER.search(title):
        yield (
            f"Canvas passes over columns that look like its totals, and may do so with {clean(title)!r}: "
            "give the assignment another name, and --title that"
        )
    sheet = roster.worksheet
    if sheet is not None and sheet.most is not None and sheet.most != total:
        yield (
            f"moodle.csv: the worksheet's highest grade is {sheet.most:g}, "
            f"so scores out of {total:g} were made ones out of that"
        )


def _number(value: float) -> str:
    return f"{finite(value):g}"


def _write_table(rows: Iterable[Sequence[str]], path: Path) -> None:
    buffer = StringIO()
    csv.writer(buffer, lineterminator="\n").writerows(rows)
    write_text(path, buffer.getvalue())


def safe_cell(text: str) -> str:
    """A text that no spreadsheet runs as a formula: an apostrophe goes before one that looks like it."""
    # Where numbers have commas in them, tables are divided at semicolons: cells begin there, too.
    text = re.sub(rf"([;|\t]\s*)(?=[{re.escape(''.join(_FORMULA))}])", r"\1'", clean(text))
    return f"'{text}" if text.startswith(_FORMULA) or text.lstrip().startswith(_FORMULA) else text


def write_class_page(
    reports: Sequence[Report],
    similar: Sequence[tuple[str, str, str, float]],
    path: Path,
    lines: Mapping[str, ClassLine] = MappingProxyType({}),
    total: float | None = None,
    *,
    not_compared: Sequence[tuple[str, str]] = (),
    matched: Matched | None = None,
    earlier: Mapping[str, Report] = MappingProxyType({}),
) -> None:
    """Write the instructor's page; it links to each student's ``STUDENT/report.html`` beside it.

    Raises OutputError: the file can't be written.

    Parameters
    ----------
    similar : student, student, module, and the share of it that the two have in common
    lines, total : as for `write_grades`
    not_compared : student and module of files that were not looked at for likeness
    matched : whose submission is whose; None without a roster
    earlier : student -> what an earlier run had found
    """
    graded = [report for report in reports if not report.trouble]
    students = [
        (report, Counter(one.state for module in grouped(report) for one in module.functions))
        for report in reports
    ]
    scores = sorted(finite(report.score) for report in graded)
    found, by_module = misconceptions(graded), attrgetter("module")
    page = render(
        "classes.html.jinja",
        reports=reports,
        unprotected=[report for report in reports if report.unprotected],
        ungraded=[report for report in reports if report.trouble],
        broken=[(report.student, result) for report in graded for result in report.broken],
        ending=ending,
        scores=scores,
        mean=fmean(scores) if scores else 0.0,
        median=median(scores) if scores else 0.0,
        bars=_bars(scores),
        failures=_failures(graded),
        misconceptions=[(module, list(made)) for module, made in groupby(found, by_module)],
        fold=len(found) > _LONG,
        # Stable: those that as many make stay in the order of the course.
        most=sorted(found, key=lambda one: -len(one.students))[:MOST],
        unnamed=without_name(graded),
        changes=changes(earlier, graded),
        counts=[
            (str(status), number)
            for status in Status
            if (number := sum(report.count(status) for report in graded))
        ],
        similar=sorted(similar, key=lambda pair: -pair[3]),
        pairs=PAIRS,
        long=_LONG,
        many=_MANY,
        students=students,
        remarked=[
            (student, (*(line.mark.why if line.mark else ()), *line.remarks))
            for student, line in lines.items()
            if line.remarks or (line.mark and line.mark.why)
        ],
        lines=lines,
        total=total,
        not_compared=not_compared,
        matched=matched,
        undecided=any(states["undecided"] for _, states in students),
        seeds=sorted({report.seed for report in reports if report.seed is not None}),
        versions=sorted({report.version for report in reports if report.version}),
        seconds=sum(finite(report.seconds) for report in reports),
        # Relative, so that the folder can go anywhere.
        link=lambda student: f"./{quote(student, safe='', errors='replace')}/report.html",
    )
    write_text(path, page)


def _bars(scores: Sequence[float]) -> list[dict[str, float]]:
    # A full score belongs to the last bar.
    counts = Counter(min(BARS - 1, int(BARS * score + 1e-9)) for score in scores)
    most, width = max(counts.values(), default=1), 100 // BARS
    return [
        {
            "low": i * width,
            "high": (i + 1) * width,
            "number": counts[i],
            "height": round(_BAR_HEIGHT * counts[i] / most, 1),
        }
        for i in range(BARS)
    ]


def _failures(graded: Sequence[Report]) -> list[dict[str, Any]]:
    """Checks that somebody failed who has written the function, those that most failed first.

    A check that broke with the reference, too, is nobody's failure.
    """
    by_check: dict[str, list[tuple[FunctionResults, Result]]] = {}
    for report in graded:
        for function in (one for module in grouped(report) for one in module.functions):
            for result in function.results:
                by_check.setdefault(result.id, []).append((function, result))
    rows = []
    for check, members in by_check.items():
        failed = [result for _, result in members if result.status not in _NOT_FAILED]
        if not failed:
            continue
        tried = sum(function.state != "to do" for function, _ in members)
        statuses = Counter(str(result.status) for result in failed)
        rows.append(
            {
                "id": check,
                "title": failed[0].title,
                "number": len(failed),
                "tried": tried,
                "untried": len(members) - tried,
                "share": len(failed) / tried,
                # That they failed is what the table says.
                "otherwise": [pair for pair in statuses.most_common() if pair[0] != "failed"],
                "mistakes": Counter(one.mistake for one in failed if one.mistake).most_common(),
            }
        )
    return sorted(rows, key=lambda row: (-row["number"], row["id"]))
