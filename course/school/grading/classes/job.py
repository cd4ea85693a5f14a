"""One submission graded into the files of its student: what a process of the pool or a machine of a cluster does.

A job and what comes of it are plain data, and a job needs no folder that others can see too: references are a file's
name or, for another machine, the file's bytes.
"""

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from course.base.version import __version__
from course.school.grading.checks.check import References
from course.school.grading.classes.settings import GradingSettings
from course.school.grading.grading import grade
from course.school.grading.references import read_references
from course.school.grading.report import Report, for_students
from course.school.grading.worker.sandbox import protected, sandbox

RESULTS = "results.json"
"""The file that holds everything that was found."""


@dataclass(frozen=True)
class GradingJob:
    """A submission that is to be graded.

    Attributes
    ----------
    student : the name, safe as a folder's
    sources : module -> the student's file
    trouble : why there are none
    settings : what to check
    trusted : whether to grade it where its code can't be kept from doing harm, too
    remarks : what was guessed of the files, and what of them was left out
    """

    student: str
    sources: Mapping[str, bytes]
    trouble: str
    settings: GradingSettings
    trusted: bool = False
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True)
class Graded:
    """The result of a job.

    Attributes
    ----------
    report : without what there was to draw
    files : name in the student's folder -> content
    """

    report: Report
    files: Mapping[str, bytes]


def grade_job(job: GradingJob, references: Path | bytes) -> Graded:
    """Grade one submission and write its reports, as bytes.

    ``references``: a file of ``make_references``, or its content
    """
    seed = job.settings.seed
    if job.trouble:
        report = troubled(job.student, job.trouble, seed)
    else:
        report = grade(
            job.sources,
            _references(references, seed),
            seed=seed,
            modules=job.settings.modules,
            student=job.student,
            limits=job.settings.limits,
            shut_in=sandbox() if job.trusted else protected(),
        )
    report = replace(report, remarks=job.remarks)
    # Arrays to draw are most of a report's bytes.
    results = tuple(replace(result, figures=()) for result in report.results)
    return Graded(replace(report, results=results), report_files(report))


def troubled(student: str, trouble: str, seed: int) -> Report:
    """The report of a submission that can't be graded: it has no results, for a 0 would be a grade."""
    return Report(student, (), seed=seed, version=__version__, trouble=trouble)


def report_files(report: Report) -> dict[str, bytes]:
    """Everything that is written for one student to read, by file name: a hidden seed is in none of it."""
    report = for_students(report)
    from course.school.grading.reports import formats
    from course.school.grading.reports.page import as_page

    return {
        "report.html": as_page(report).encode(),
        "junit.xml": formats.as_xml(report).encode(),
        "gradescope.json": formats.json_bytes(formats.gradescope(report)),
        "prairielearn.json": formats.json_bytes(formats.prairielearn(report)),
        RESULTS: formats.json_bytes(formats.as_json(report)),
    }


@lru_cache(maxsize=2)
def _references(file: Path | bytes, seed: int) -> References:
    """Read once in each process."""
    if isinstance(file, Path):
        return read_references(file, seed)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "references.npz"
        path.write_bytes(file)
        return read_references(path, seed)
