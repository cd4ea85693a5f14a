"""Grade a whole class into a folder, in as many goes as it takes.

What is done stays done: a run that was interrupted goes on with the same command, and only what has changed is graded
anew. A fault of the grader is nobody's grade: it is told, kept out of what a later run would take for done, and the
others go on.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType

from course.base.errors import CourseError, OutputError
from course.base.version import __version__
from course.school.grading.catalog import with_whole
from course.school.grading.classes.engines import Engine, Outcome
from course.school.grading.classes.job import (
    RESULTS,
    Graded,
    GradingJob,
    grade_job,
    report_files,
    troubled,
)
from course.school.grading.classes.keeping import fingerprint, keep, kept
from course.school.grading.classes.names import NOT_CERTAIN
from course.school.grading.classes.policy import MODIFIED, Mark, Rules, mark
from course.school.grading.classes.roster import Matched, Roster, match
from course.school.grading.classes.settings import INSTRUCTOR, GradingSettings
from course.school.grading.classes.similarity import Compared, compare
from course.school.grading.classes.submitted import Submission, find_submissions
from course.school.grading.references import make_references
from course.school.grading.report import Report, grouped
from course.school.grading.worker.sandbox import protected

FAULT = "grader error"
"""How the trouble of a report begins that is no fault of the student's."""

TOTAL = 100.0
"""Of the score where no policy says another."""

_LAST = datetime.max.replace(tzinfo=UTC, microsecond=0).timestamp()

ClassEngine = Engine[GradingJob, Path | bytes, Graded]


@dataclass(frozen=True)
class Runner:
    """An engine and how it is used, whatever is checked.

    Attributes
    ----------
    engine : does the work
    send_references : whether the engine's workers can't read files of this machine
    trusted : whether to grade where the code can't be kept from doing harm, too
    progress : called with the number of submissions that are done, and of all
    """

    engine: ClassEngine
    send_references: bool = False
    trusted: bool = False
    progress: Callable[[int, int], None] = lambda _done, _of: None

    def check(self, folder: Path, out: Path) -> None:
        """Raise ``NotProtected`` where the code can't be kept from doing harm here, and isn't trusted."""
        if not self.trusted and not self.send_references:
            protected((folder, out))


@dataclass(frozen=True)
class Finished:
    """Results of a class as a whole.

    Attributes
    ----------
    compared : which submissions are alike
    matched : whose submission is whose; None without a roster
    unused : students of the policy who have handed in nothing
    files : tables that were written
    unprotected : why no grade is certain of students whose code nothing kept from doing harm; empty if there are none
    told : what of the roster was passed over, and what a learning system will pass over
    """

    compared: Compared = field(default_factory=Compared)
    matched: Matched | None = None
    unused: tuple[str, ...] = ()
    files: tuple[Path, ...] = ()
    unprotected: str = ""
    told: tuple[str, ...] = ()


@dataclass(frozen=True)
class ClassResult:
    """Results of grading a class.

    Attributes
    ----------
    submissions : in the order of their names
    reports : of all of them, in the same order
    graded : how many of them this run has graded
    finished : what came of the class as a whole
    """

    submissions: tuple[Submission, ...]
    reports: tuple[Report, ...]
    graded: int
    finished: Finished = field(default_factory=Finished)

    @property
    def faults(self) -> list[str]:
        """Students whom a fault of the grader has left without a grade."""
        return sorted(one.student for one in self.reports if one.trouble.startswith(FAULT))

    @property
    def doubtful(self) -> list[str]:
        """Students of whom a check broke; its points are given if it breaks with the reference as well."""
        return [report.student for report in self.reports if report.broken]


def grade_class(folder: Path, out: Path, settings: GradingSettings, runner: Runner) -> ClassResult:
    """Grade every submission in a folder.

    Parameters
    ----------
    folder : holds the submissions, as `find_submissions` reads them
    out : gets a folder for each student, and the class's tables and page

    Raises
    ------
    NotProtected
        The code can't be kept from doing harm here, and isn't trusted.
    CourseError
        There are no submissions, or nothing can be written to ``out``.
    """
    if folder.resolve() in (out.resolve(), out.resolve().parent):
        raise CourseError(f"{out}: lies where the submissions are; choose a folder elsewhere")
    # Before hours of grading.
    runner.check(folder, out)
    terms = settings.read()
    submissions = find_submissions(folder, settings.modules)
    earlier = {one.student: report for one in submissions if (report := kept(out, one.student))}
    result = grade_all(submissions, out, settings, runner)
    finished = finish(result.submissions, result.reports, out, settings, terms, earlier)
    settings.write(out)
    return replace(result, finished=finished)


def grade_all(
    submissions: Sequence[Submission],
    out: Path,
    settings: GradingSettings,
    runner: Runner,
    code: str = "",
) -> ClassResult:
    """Grade submissions, and write a folder for each student.

    ``code``: what else a result that was kept must have been made with
    """
    try:
        (out / INSTRUCTOR).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{out}: can't be written: {error.strerror}") from error
    marks = {one.student: fingerprint(one, settings, code) for one in submissions}
    found = {student: kept(out, student, mark) for student, mark in marks.items()}
    reports = {
        student: report
        for student, report in found.items()
        if report is not None and (runner.trusted or not report.unprotected)
    }
    jobs = [
        GradingJob(one.student, one.sources, one.trouble, settings, runner.trusted, one.remarks)
        for one in submissions
        if one.student not in reports
    ]
    runner.progress(len(reports), len(submissions))
    if jobs:
        references = out / INSTRUCTOR / f"references_{settings.seed}.npz"
        make_references(with_whole(settings.modules), settings.seed, references)
        shared = references.read_bytes() if runner.send_references else references
        outcomes = runner.engine(grade_job, jobs, shared)
        try:
            for outcome in outcomes:
                student = outcome.item.student
                reports[student] = _keep(out, outcome, marks[student])
                runner.progress(len(reports), len(submissions))
        finally:
            outcomes.close()
    ordered = tuple(reports[one.student] for one in submissions)
    return ClassResult(tuple(submissions), ordered, len(jobs))


def _keep(out: Path, outcome: Outcome[GradingJob, Graded], mark: str) -> Report:
    """Write what came of one submission."""
    graded, fault = outcome.value, outcome.fault
    if graded is not None and graded.report.version != __version__:
        fault = f"graded by version {graded.report.version}, not {__version__}"
    if graded is not None and not fault:
        # The next run grades it again if a check had an error of its own.
        keep(out, graded, "" if graded.report.broken else mark)
        return graded.report
    report = troubled(outcome.item.student, f"{FAULT}: {fault}", outcome.item.settings.seed)
    try:
        files = report_files(report)
        del files[RESULTS]
    except Exception:  # noqa: BLE001 - it may be the reports that are at fault
        files = {}
    # The record that would stop another try is left out.
    keep(out, Graded(report, files), None)
    return report


def finish(
    submissions: Sequence[Submission],
    reports: Sequence[Report],
    out: Path,
    settings: GradingSettings,
    terms: tuple[Rules | None, Roster | None],
    earlier: Mapping[str, Report] = MappingProxyType({}),
) -> Finished:
    """Write grades.csv, class.html, lecture.html, and with a roster canvas.csv and moodle.csv.

    The names of the last two begin with ``NOT_CERTAIN`` where a submission was graded without protection.

    Parameters
    ----------
    submissions, reports : in the same order
    terms : policy and roster
    earlier : student -> what an earlier run had found
    """
    from course.school.grading.reports.classes import (
        ClassLine,
        doubts_of,
        write_class_page,
        write_grades,
    )
    from course.school.grading.reports.insight import write_lecture_page

    rules, roster = terms
    (out / INSTRUCTOR).mkdir(parents=True, exist_ok=True)
    compared = compare(submissions, settings.modules, out / INSTRUCTOR / "similarity.npz")
    marks = _marks(submissions, reports, rules)
    lines = {
        one.student: ClassLine((*one.remarks, *_unusable(one, report)), marks.get(one.student))
        for one, report in zip(submissions, reports, strict=True)
    }
    total = None if rules is None else rules.policy.total
    matched = None
    if roster is not None:
        matched = match(roster.students, {one.student: one.claims for one in submissions})
    open_to = [report.unprotected for report in reports if report.unprotected]
    unprotected = f"{open_to[0]} ({len(open_to)} of {len(reports)} graded so)" if open_to else ""
    grades, page = out / "grades.csv", out / "class.html"
    write_grades(reports, grades, lines, total)
    write_class_page(
        reports,
        [(pair.first, pair.second, pair.module, pair.share) for pair in compared.similar],
        page,
        lines,
        total,
        not_compared=compared.left_out,
        matched=matched,
        earlier=earlier,
    )
    write_lecture_page([report for report in reports if not report.trouble], out / "lecture.html")
    scores = {
        one.student: marks[one.student].final if total is not None else TOTAL * one.score
        for one in reports
        if not one.trouble
    }
    before = NOT_CERTAIN if unprotected else ""
    tables = _write_for_systems(out, before, scores, total, matched, roster, settings.title)
    used = {rules.student(one.names)[0] for one in submissions} if rules else set()
    unused = tuple(one for one in rules.policy.students if one not in used) if rules else ()
    told = (
        () if roster is None else (*roster.told, *doubts_of(roster, settings.title, total or TOTAL))
    )
    return Finished(compared, matched, unused, (grades, page, *tables), unprotected, told)


def _unusable(submission: Submission, report: Report) -> tuple[str, ...]:
    """What is told of files that were handed in, and of which no function can be called: a 0 that has a reason."""
    return tuple(
        module.trouble.found
        for module in grouped(report)
        if module.trouble and module.name in submission.sources
    )


def _marks(
    submissions: Sequence[Submission], reports: Sequence[Report], rules: Rules | None
) -> dict[str, Mark]:
    if rules is None:
        return {}
    by_file = rules.policy.times == MODIFIED
    found = {
        one.student: mark(report, rules, one.names, modified(one) if by_file else None)
        for one, report in zip(submissions, reports, strict=True)
    }
    return {student: score for student, score in found.items() if score is not None}


def modified(submission: Submission) -> datetime | None:
    """When the newest file of a submission was written."""
    times = []
    for path in submission.paths:
        for file in [path, *(path.rglob("*") if path.is_dir() else ())]:
            try:
                if not file.is_dir():
                    times.append(max(0.0, file.lstat().st_mtime))
            except OSError:
                continue
    # An archive may have given a file any time: also one after all years that a date can have.
    return datetime.fromtimestamp(min(max(times), _LAST), UTC) if times else None


def _write_for_systems(
    out: Path,
    before: str,
    scores: Mapping[str, float],
    total: float | None,
    matched: Matched | None,
    roster: Roster | None,
    title: str,
) -> list[Path]:
    """Write what learning systems import; tables of an earlier run are not left behind."""
    from course.school.grading.reports.classes import SYSTEMS, write_gradebook

    for name in SYSTEMS:
        for path in (out / name, out / f"{NOT_CERTAIN}{name}"):
            path.unlink(missing_ok=True)
    if matched is None or roster is None:
        return []
    of_students = matched.students
    grades = [(of_students[one], score) for one, score in scores.items() if one in of_students]
    tables = {name: out / f"{before}{name}" for name in SYSTEMS}
    for name, path in tables.items():
        write_gradebook(name, roster, grades, TOTAL if total is None else total, title, path)
    return [*tables.values()]
