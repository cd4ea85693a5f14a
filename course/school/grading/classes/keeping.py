"""Files that are kept of each student: reports to hand out, and a record by which a later run finds them.

``STUDENT/`` may be handed out. The record is the instructor's: it holds the seed, and a fingerprint of what was graded
from which the seed could be found by trying. It comes last; where it stands, all the other files stand too, and a run
with the same submission, seed, version and modules need not grade it again.
"""

import hashlib
import json
from dataclasses import fields
from pathlib import Path

from course.base.atomic import replacing
from course.base.errors import OutputError
from course.base.version import __version__
from course.school.grading.checks.result import Result, Status
from course.school.grading.classes.job import RESULTS, Graded
from course.school.grading.classes.settings import INSTRUCTOR, GradingSettings
from course.school.grading.classes.submitted import Submission
from course.school.grading.report import Report
from course.school.grading.reports.formats import as_json, json_bytes

_REPORT = [field.name for field in fields(Report)]
_RESULT = [field.name for field in fields(Result) if field.name not in ("figures", "instructor")]


def fingerprint(submission: Submission, settings: GradingSettings, code: str = "") -> str:
    """One line that changes whenever the result may: with submission, seed, version, modules or the grader's code."""
    seconds, sources = settings.submission_seconds, submission.sources
    parts = [__version__, settings.seed, settings.modules, submission.trouble, submission.remarks]
    parts += [code] if code else []
    parts += [] if seconds is None else [f"{seconds:g} s"]
    files = [(name, hashlib.sha256(sources[name]).hexdigest()) for name in sorted(sources)]
    return hashlib.sha256(json.dumps([*parts, files]).encode()).hexdigest()


def keep(out: Path, graded: Graded, mark: str | None) -> None:
    """Write a student's files, and the record that says that all are there last.

    Parameters
    ----------
    out : of the class
    mark : the fingerprint of what was graded; empty if the next run is to grade it again, None for no record
    """
    folder, record = out / graded.report.student, _record(out, graded.report.student)
    try:
        for path in (folder, record.parent):
            path.mkdir(parents=True, exist_ok=True)
        # Until the new files are there, the folder is nobody's result.
        for path in (record, folder / RESULTS):
            path.unlink(missing_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: can't be written: {error.strerror}") from error
    for name, content in graded.files.items():
        _write(folder / name, content)
    if mark is not None:
        how = {result.id: result.instructor for result in graded.report.broken}
        kept_with = {"fingerprint": mark, "broken": how}
        _write(record, json_bytes(as_json(graded.report) | kept_with))


def kept(out: Path, student: str, mark: str | None = None) -> Report | None:
    """The report of an earlier run, on the very same if its fingerprint is given; None if there is none."""
    try:
        found = json.loads(_record(out, student).read_bytes())
        if mark is not None and found["fingerprint"] != mark:
            return None
        results = tuple(
            Result(
                **{name: result[name] for name in _RESULT} | {"status": Status(result["status"])}
            )
            for result in found["results"]
        )
        return Report(**{name: found[name] for name in _REPORT} | {"results": results})
    except (OSError, ValueError, KeyError, TypeError):
        return None  # Not there, or not ours.


def recorded(out: Path) -> tuple[str, ...]:
    """Students of whom an earlier run has kept something, in the order of their names."""
    return tuple(sorted(path.stem for path in _record(out, "").parent.glob("*.json")))


def kept_files(out: Path, report: Report) -> Graded:
    """The files that an earlier run has kept of a student, to be kept elsewhere."""
    files = {path.name: path.read_bytes() for path in (out / report.student).iterdir()}
    return Graded(report, files)


def _record(out: Path, student: str) -> Path:
    return out / INSTRUCTOR / "records" / f"{student}.json"


def _write(path: Path, content: bytes) -> None:
    with replacing(path) as temporary:
        temporary.write_bytes(content)
