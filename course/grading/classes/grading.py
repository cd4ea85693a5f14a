"""Grade a whole class into a folder, in as many goes as it takes.

What is done stays done: a run that was interrupted goes on with the same command, and only what has changed is graded
anew. A fault of the grader is nobody's grade: it is told, kept out of what a later run would take for done, and the
others go on.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from course import __version__
from course.effects import PROJECT
from course.errors import CourseError, OutputError
from course.grading.checks.result import Status
from course.grading.classes.job import Graded, Job, grade_job, report_files, troubled, with_whole
from course.grading.classes.keeping import LAST, fingerprint, keep, kept
from course.grading.classes.outcome import Engine
from course.grading.classes.similarity import Similar, find_similar
from course.grading.classes.submitted import Submission, find_submissions
from course.grading.references import SOLUTIONS, make_references
from course.grading.release.stubs import make_stub
from course.grading.report import Report

FAULT = "grader error"
"""How the trouble of a report begins that is no fault of the student's."""

ClassEngine = Engine[Job, Path | bytes, Graded]


@dataclass(frozen=True)
class ClassResult:
    """What grading a class gave.

    Attributes
    ----------
    reports : of all students, in the order of their names
    graded : how many of them this run has graded
    faults : students whom a fault of the grader has left without a grade
    doubtful : students of whom a check ended in an error of its own; its points are given
    similar : pairs of submissions that are too much alike
    """

    reports: tuple[Report, ...]
    graded: int
    faults: tuple[str, ...]
    doubtful: tuple[str, ...]
    similar: tuple[Similar, ...]


def grade_class(
    folder: Path,
    out: Path,
    engine: ClassEngine,
    *,
    seed: int,
    modules: Sequence[str],
    send_references: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> ClassResult:
    """Grade every submission in a folder.

    Parameters
    ----------
    folder : holds the submissions, folders and zip files
    out : gets a folder for each student, ``grades.csv`` and ``class.html``
    engine : does the work
    seed, modules : what to check
    send_references : whether the engine's workers can't read files of this machine
    progress : called with the number of submissions that are done, and of all

    Raises
    ------
    CourseError
        There are no submissions or two with one name, or nothing can be written to ``out``.
    """
    from course.grading.reports.classes import write_class_page, write_grades

    modules = tuple(modules)
    submissions = find_submissions(folder, modules)
    if folder.resolve() in (out.resolve(), out.resolve().parent):
        raise CourseError(f"{out}: lies where the submissions are; choose a folder elsewhere")
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{out}: can't be written: {error.strerror}") from error
    marks = {
        one.student: fingerprint(one.sources, one.trouble, seed, modules) for one in submissions
    }
    reports: dict[str, Report] = {}
    for one in submissions:
        report = kept(out / one.student, marks[one.student])
        if report is not None:
            reports[one.student] = report
    jobs = [
        Job(one.student, one.sources, one.trouble, seed, modules)
        for one in submissions
        if one.student not in reports
    ]
    faults = []
    if progress is not None:
        progress(len(reports), len(submissions))
    if jobs:
        references = out / f"references_{seed}.npz"
        make_references(with_whole(modules), seed, references)
        shared = references.read_bytes() if send_references else references
        outcomes = engine(grade_job, jobs, shared)
        try:
            for outcome in outcomes:
                student = outcome.item.student
                fault, graded = outcome.fault, outcome.value
                if graded is not None and graded.report.version != __version__:
                    fault = f"graded by version {graded.report.version}, not {__version__}"
                if fault or graded is None:
                    faults.append(student)
                    reports[student] = _keep_fault(out / student, student, fault, seed)
                else:
                    # The next run grades it again if a check had an error of its own.
                    doubtful = graded.report.count(Status.GRADER_ERROR) > 0
                    keep(out / student, graded, "" if doubtful else marks[student])
                    reports[student] = graded.report
                if progress is not None:
                    progress(len(reports), len(submissions))
        finally:
            outcomes.close()
    ordered = tuple(reports[one.student] for one in submissions)
    similar = _similar(submissions, modules)
    write_grades(ordered, out / "grades.csv")
    write_class_page(
        ordered,
        [(pair.first, pair.second, pair.module, pair.share) for pair in similar],
        out / "class.html",
    )
    with_errors = tuple(report.student for report in ordered if report.count(Status.GRADER_ERROR))
    return ClassResult(ordered, len(jobs), tuple(sorted(faults)), with_errors, similar)


def _keep_fault(folder: Path, student: str, fault: str, seed: int) -> Report:
    """Write what there is to say; the file that would stop another try is left out."""
    report = troubled(student, f"{FAULT}: {fault}", seed)
    try:
        files = report_files(report)
        del files[LAST]
    except Exception:  # noqa: BLE001 - it may be the reports that are at fault
        files = {}
    keep(folder, Graded(report, files), "")
    return report


def _similar(submissions: Sequence[Submission], modules: Sequence[str]) -> tuple[Similar, ...]:
    found: list[Similar] = []
    for module in modules:
        path = SOLUTIONS / f"{module}.py"
        stub = make_stub(
            path.read_text(encoding="utf-8"), module, str(path.relative_to(PROJECT))
        ).text
        sources = {one.student: one.sources[module] for one in submissions if module in one.sources}
        found += find_similar(module, sources, stub)
    return tuple(found)
