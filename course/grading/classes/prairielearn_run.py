"""Grade the one submission that PrairieLearn has put into the container: the image's ``run`` starts this.

Everything is in /grade: the student's files in ``student``, and what PrairieLearn reads in ``results/results.json``.
"""

from __future__ import annotations

import argparse
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path

from course.atomic import replacing
from course.errors import CourseError
from course.grading.checks.preparing import References
from course.grading.classes.job import troubled
from course.grading.classes.submitted import read_one
from course.grading.grading import grade
from course.grading.references import read_references, references
from course.grading.report import Report
from course.grading.reports.formats import json_bytes, prairielearn
from course.grading.worker.limits import Limits
from course.grading.worker.sandbox import protected, sandbox
from course.modules import COURSE

CALL_SECONDS = 20.0
"""A container that shares its cores takes twice the time."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Grade ROOT/student into ROOT/results/results.json; 0, or 1 after a fault of the grader.

    Parameters
    ----------
    arguments : of the command line; this process's if not given
    """
    parser = argparse.ArgumentParser(prog="run", description="Grade for PrairieLearn.")
    parser.add_argument("--root", type=Path, default=Path("/grade"))
    parser.add_argument("--references", type=Path, required=True)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--modules", default=",".join(COURSE))
    parser.add_argument("--seconds", type=float, help="for all of a submission")
    parser.add_argument("--trust-submissions", action="store_true")
    options = parser.parse_args(arguments)
    results = options.root / "results" / "results.json"
    try:
        results.parent.mkdir(parents=True, exist_ok=True)
        results.parent.chmod(0o700)
        _write(_grade(options), results)
    except Exception:  # noqa: BLE001 - whatever it is, it is no mistake of the student's
        traceback.print_exc()
        # Without results PrairieLearn says that the grader has failed; with some, they would be a grade.
        results.unlink(missing_ok=True)
        return 1
    return 0


def _grade(options: argparse.Namespace) -> Report:
    modules = options.modules.split(",")
    secrets = (options.root / "results", options.references)
    shut_in = sandbox(secrets=secrets) if options.trust_submissions else protected(secrets)
    submission = read_one("", (options.root / "student").resolve(), modules)
    if submission.trouble:
        return troubled("", submission.trouble, options.seed)
    return grade(
        submission.sources,
        _references(options.references, options.seed),
        seed=options.seed,
        modules=modules,
        limits=Limits(call_seconds=CALL_SECONDS, submission_seconds=options.seconds),
        shut_in=shut_in,
    )


def _references(path: Path, seed: int) -> References:
    """Those that came with the image, or made now."""
    try:
        return read_references(path, seed)
    except CourseError:
        return references(seed)


def _write(report: Report, path: Path) -> None:
    for result in report.broken:
        # What is printed here only instructors see.
        sys.stderr.write(f"{result.id} broke:\n{result.instructor}\n")
    with replacing(path) as temporary:
        temporary.write_bytes(json_bytes(prairielearn(report)))


if __name__ == "__main__":
    sys.exit(main())
