"""The whole class: a table of grades for a spreadsheet, and one page for the instructor."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from statistics import fmean, median
from types import MappingProxyType
from urllib.parse import quote

from course.atomic import write_text
from course.grading.checks.result import Result, Status
from course.grading.classes.marks import Mark
from course.grading.classes.roster import Matched
from course.grading.report import Report, ending
from course.grading.reports.grouping import grouped
from course.grading.reports.templates import render
from course.grading.reports.text import clean, finite

MARKS = ("raw", "adjusted", "final")
"""Columns of the score by a policy."""

BARS = 10
"""Of the histogram of scores."""

_BAR_HEIGHT = 165
_FORMULA = tuple("=+-@\t\r\n\uff1d\uff0b\uff0d\uff20")
"""What makes a spreadsheet take a text for a formula: the four signs, full-width ones too, and blanks before them."""


@dataclass(frozen=True)
class Line:
    """What there is to say of a student besides what was found.

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
    lines: Mapping[str, Line] = MappingProxyType({}),
    total: float | None = None,
) -> None:
    """Write grades.csv: student, score, points, of, which checks broke, remarks, then the points of each function.

    A submission that could not be graded has no numbers: a 0 would look like a grade.

    Parameters
    ----------
    lines : student -> what else there is to say
    total : score of who has earned all; with it come the columns raw, adjusted and final

    Raises
    ------
    OutputError
        The file can't be written.
    """
    functions: dict[str, None] = {}
    tables: list[dict[str, float]] = []
    for report in reports:
        points = {
            f"{function.module}.{function.name}": function.points
            for module in grouped(report)
            for function in module.functions
        }
        functions.update(dict.fromkeys(points))
        tables.append(points)
    buffer = StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    head = ["student", "score", "points", "of", *([] if total is None else MARKS)]
    head += ["broken checks", "remarks"]
    writer.writerow([*head, *(safe_cell(name) for name in functions)])
    for report, points in zip(reports, tables, strict=True):
        line = lines.get(report.student, Line())
        score = line.mark
        grades = [report.score, report.points, report.of]
        if total is not None:
            grades += [0.0] * 3 if score is None else [score.raw, score.adjusted, score.final]
        why = () if score is None else score.why
        writer.writerow(
            [
                safe_cell(report.student),
                *("" if report.trouble else f"{finite(grade):g}" for grade in grades),
                safe_cell(" ".join(result.id for result in report.broken)),
                safe_cell(
                    "; ".join(
                        filter(None, (report.unprotected, report.trouble, *why, *line.remarks))
                    )
                ),
                *(f"{finite(points[name]):g}" if name in points else "" for name in functions),
            ]
        )
    write_text(path, buffer.getvalue())


def safe_cell(text: str) -> str:
    """A text that no spreadsheet runs as a formula: an apostrophe goes before one that looks like it."""
    text = clean(text)
    return f"'{text}" if text.startswith(_FORMULA) or text.lstrip().startswith(_FORMULA) else text


@dataclass(frozen=True)
class _Bar:
    low: int
    high: int
    number: int
    height: float


@dataclass(frozen=True)
class _Row:
    """One check that somebody didn't pass."""

    id: str
    title: str
    number: int
    share: float
    statuses: list[tuple[str, int]]
    mistakes: list[tuple[str, int]]


def write_class_page(
    reports: Sequence[Report],
    similar: Sequence[tuple[str, str, str, float]],
    path: Path,
    lines: Mapping[str, Line] = MappingProxyType({}),
    total: float | None = None,
    *,
    not_compared: Sequence[tuple[str, str]] = (),
    matched: Matched | None = None,
) -> None:
    """Write the instructor's page; it links to each student's ``STUDENT/report.html`` beside it.

    Parameters
    ----------
    similar : student, student, module, and the share of it that the two have in common
    lines, total : as for `write_grades`
    not_compared : student and module of files that were not looked at for likeness
    matched : whose submission is whose; None without a roster

    Raises
    ------
    OutputError
        The file can't be written.
    """
    graded = [report for report in reports if not report.trouble]
    students = [(report, _states(report)) for report in reports]
    scores = sorted(finite(report.score) for report in graded)
    page = render(
        "classes.html.jinja",
        reports=reports,
        unprotected=[report for report in reports if report.unprotected],
        ungraded=[report for report in reports if report.trouble],
        broken=[(report.student, report.broken) for report in graded if report.broken],
        ending=ending,
        scores=scores,
        mean=fmean(scores) if scores else 0.0,
        median=median(scores) if scores else 0.0,
        bars=_bars(scores),
        failures=_failures(graded),
        counts=[
            (str(status), number)
            for status in Status
            if (number := sum(report.count(status) for report in graded))
        ],
        similar=sorted(similar, key=lambda pair: -pair[3]),
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
        link=_link,
    )
    write_text(path, page)


def _link(student: str) -> str:
    """Relative, so that the folder can go anywhere."""
    return f"./{quote(student, safe='', errors='replace')}/report.html"


def _states(report: Report) -> Counter[str]:
    return Counter(function.state for module in grouped(report) for function in module.functions)


def _bars(scores: Sequence[float]) -> list[_Bar]:
    # A full score belongs to the last bar.
    counts = Counter(min(BARS - 1, int(BARS * score + 1e-9)) for score in scores)
    most = max(counts.values(), default=1)
    width = 100 // BARS
    return [
        _Bar(i * width, (i + 1) * width, counts[i], round(_BAR_HEIGHT * counts[i] / most, 1))
        for i in range(BARS)
    ]


def _failures(graded: Sequence[Report]) -> list[_Row]:
    by_check: dict[str, list[Result]] = {}
    for report in graded:
        for result in report.results:
            if result.status is not Status.PASSED:
                by_check.setdefault(result.id, []).append(result)
    rows = [
        _Row(
            check,
            results[0].title,
            len(results),
            len(results) / len(graded),
            Counter(str(result.status) for result in results).most_common(),
            Counter(result.mistake for result in results if result.mistake).most_common(),
        )
        for check, results in by_check.items()
    ]
    return sorted(rows, key=lambda row: (-row.number, row.id))
