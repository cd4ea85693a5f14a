"""Grade a whole class into a folder, in as many goes as it takes.

What is done stays done: a run that was interrupted goes on with the same command, and only what has changed is graded
anew. A fault of the grader is nobody's grade: it is told, kept out of what a later run would take for done, and the
others go on.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from course import __version__
from course.errors import CourseError, OutputError
from course.grading.classes.finishing import Finished, Terms, finish
from course.grading.classes.job import (
    RESULTS,
    Graded,
    Job,
    grade_job,
    report_files,
    troubled,
    with_whole,
)
from course.grading.classes.keeping import INSTRUCTOR, fingerprint, keep, kept
from course.grading.classes.outcome import Engine
from course.grading.classes.settings import settings_of, write_settings
from course.grading.classes.submitted import Submission, find_submissions
from course.grading.references import make_references
from course.grading.report import Report
from course.grading.worker.limits import Limits
from course.grading.worker.sandbox import protected

FAULT = "grader error"
"""How the trouble of a report begins that is no fault of the student's."""

ClassEngine = Engine[Job, Path | bytes, Graded]
Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class ClassResult:
    """What grading a class gave.

    Attributes
    ----------
    submissions : in the order of their names
    reports : of all of them, in the same order
    graded : how many of them this run has graded
    faults : students whom a fault of the grader has left without a grade
    doubtful : students of whom a check broke; its points are given if it breaks with the reference as well
    finished : what came of the class as a whole
    """

    submissions: tuple[Submission, ...]
    reports: tuple[Report, ...]
    graded: int
    faults: tuple[str, ...]
    doubtful: tuple[str, ...]
    finished: Finished = field(default_factory=Finished)


def grade_class(
    folder: Path,
    out: Path,
    engine: ClassEngine,
    *,
    seed: int,
    modules: Sequence[str],
    terms: Terms | None = None,
    send_references: bool = False,
    trusted: bool = False,
    limits: Limits | None = None,
    progress: Progress | None = None,
) -> ClassResult:
    """Grade every submission in a folder.

    Parameters
    ----------
    folder : holds the submissions, as `find_submissions` reads them
    out : gets a folder for each student, and the class's tables and page
    engine : does the work
    seed, modules : what to check
    terms : what makes grades of points; nothing but the points if not given
    send_references : whether the engine's workers can't read files of this machine
    trusted : whether to grade where the code can't be kept from doing harm, too
    limits : what the code of one submission may use; the usual if not given
    progress : called with the number of submissions that are done, and of all

    Raises
    ------
    NotProtected
        The code can't be kept from doing harm here, and isn't trusted.
    CourseError
        There are no submissions, or nothing can be written to ``out``.
    """
    modules, terms = tuple(modules), terms or Terms()
    if folder.resolve() in (out.resolve(), out.resolve().parent):
        raise CourseError(f"{out}: lies where the submissions are; choose a folder elsewhere")
    # Before hours of grading.
    if not trusted and not send_references:
        protected((folder, out))
    rules, roster = terms.read(modules)
    result = grade_all(
        find_submissions(folder, modules),
        out,
        engine,
        seed=seed,
        modules=modules,
        send_references=send_references,
        trusted=trusted,
        limits=limits,
        progress=progress,
    )
    finished = finish(result.submissions, result.reports, out, modules, rules, roster, terms.title)
    seconds = None if limits is None else limits.submission_seconds
    write_settings(settings_of(seed, modules, terms, seconds), out)
    return replace(result, finished=finished)


def grade_all(
    submissions: Sequence[Submission],
    out: Path,
    engine: ClassEngine,
    *,
    seed: int,
    modules: tuple[str, ...],
    code: str = "",
    send_references: bool = False,
    trusted: bool = False,
    limits: Limits | None = None,
    progress: Progress | None = None,
) -> ClassResult:
    """Grade submissions, and write a folder for each student.

    Parameters
    ----------
    code : what else a result that was kept must have been made with
    """
    limits = limits or Limits()
    try:
        (out / INSTRUCTOR).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{out}: can't be written: {error.strerror}") from error
    marks = {
        one.student: fingerprint(
            one.sources, one.trouble, seed, modules, code, limits.submission_seconds
        )
        for one in submissions
    }
    reports = {
        one.student: report
        for one in submissions
        if (report := kept(out, one.student, marks[one.student])) is not None
        and (trusted or not report.unprotected)
    }
    jobs = [
        Job(one.student, one.sources, one.trouble, seed, modules, trusted, limits)
        for one in submissions
        if one.student not in reports
    ]
    faults: list[str] = []
    if progress is not None:
        progress(len(reports), len(submissions))
    if jobs:
        references = out / INSTRUCTOR / f"references_{seed}.npz"
        make_references(with_whole(modules), seed, references)
        shared = references.read_bytes() if send_references else references
        outcomes = engine(grade_job, jobs, shared)
        try:
            for outcome in outcomes:
                student = outcome.item.student
                report = _keep(out, student, outcome.value, outcome.fault, marks[student], seed)
                reports[student] = report
                faults += [student] if report.trouble.startswith(FAULT) else []
                if progress is not None:
                    progress(len(reports), len(submissions))
        finally:
            outcomes.close()
    ordered = tuple(reports[one.student] for one in submissions)
    doubtful = tuple(report.student for report in ordered if report.broken)
    return ClassResult(tuple(submissions), ordered, len(jobs), tuple(sorted(faults)), doubtful)


def _keep(
    out: Path, student: str, graded: Graded | None, fault: str, mark: str, seed: int
) -> Report:
    """Write what came of one submission."""
    if graded is not None and graded.report.version != __version__:
        fault = f"graded by version {graded.report.version}, not {__version__}"
    if fault or graded is None:
        return _keep_fault(out, student, fault, seed)
    # The next run grades it again if a check had an error of its own.
    keep(out, graded, "" if graded.report.broken else mark)
    return graded.report


def _keep_fault(out: Path, student: str, fault: str, seed: int) -> Report:
    """Write what there is to say; the record that would stop another try is left out."""
    report = troubled(student, f"{FAULT}: {fault}", seed)
    try:
        files = report_files(report)
        del files[RESULTS]
    except Exception:  # noqa: BLE001 - it may be the reports that are at fault
        files = {}
    keep(out, Graded(report, files), None)
    return report
