"""Grade the one submission that Gradescope or PrairieLearn has put into its container.

    python -m course.school.grading.classes.container gradescope --root /autograder
    python -m course.school.grading.classes.container prairielearn --root /grade --references FILE

Gradescope ends what takes longer than its limit, so its results are written anew after every check: what has been
earned until then counts. Whatever has not been reached stands in them with its points to earn.
"""

import argparse
import json
import sys
import traceback
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Any

from course.base.atomic import replacing
from course.base.errors import CourseError
from course.base.version import __version__
from course.engine.functions.modules import COURSE
from course.school.grading.catalog import module_checks, with_whole
from course.school.grading.checks.check import References
from course.school.grading.checks.result import Result, Status, result_of
from course.school.grading.classes.bundles import REFERENCES
from course.school.grading.classes.job import troubled
from course.school.grading.classes.submitted import read_one
from course.school.grading.grading import grade
from course.school.grading.references import read_references, references
from course.school.grading.report import Report
from course.school.grading.reports.formats import gradescope, json_bytes, prairielearn
from course.school.grading.worker.limits import Limits
from course.school.grading.worker.sandbox import NotProtected, protected, sandbox

CALL_SECONDS = 20.0
"""Half a core, as Gradescope gives it, and a container that shares its cores take twice the usual time."""

NOT_REACHED = "the time was over before this check"


def main(arguments: Sequence[str] | None = None) -> int:
    """Grade the submission below ROOT into ROOT/results/results.json; 0, or 1 after a fault of the grader.

    ``arguments``: of the command line; this process's if not given
    """
    parser = argparse.ArgumentParser(prog="container", description="Grade one submission.")
    parser.add_argument("system", choices=["gradescope", "prairielearn"])
    parser.add_argument("--root", type=Path, required=True)
    parser.add_argument("--references", type=Path, help="for Gradescope those of the archive")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--modules", default=",".join(COURSE))
    parser.add_argument("--seconds", type=float, help="for all of a submission")
    parser.add_argument("--trust-submissions", action="store_true")
    parser.add_argument("--walls", action="store_true", help="only say what keeps submissions in")
    options = parser.parse_args(arguments)
    options.references = options.references or options.root / "source" / REFERENCES
    results = options.root / "results" / "results.json"
    # Of what students' code must not read: there is no other submission, and the solutions are known.
    secrets = (results.parent, options.references)
    if options.walls:
        return _tell_walls(secrets)
    try:
        _grade(options, results, secrets)
    except Exception:  # noqa: BLE001 - whatever it is, it is no mistake of the student's
        traceback.print_exc()
        # Without results the system says that the grader has failed; with some, they would be a grade.
        results.unlink(missing_ok=True)
        return 1
    return 0


def _tell_walls(secrets: tuple[Path, ...]) -> int:
    """Say when the image is built what would otherwise be found out by the first submission."""
    try:
        protections = protected(secrets).protections
    except NotProtected as error:
        protections = (f"Submissions will not be graded: {error}",)
    sys.stdout.write("\n".join((*protections, "")))
    return 0


def _grade(options: argparse.Namespace, results: Path, secrets: tuple[Path, ...]) -> None:
    on_gradescope = options.system == "gradescope"
    seed, modules = options.seed, options.modules.split(",")
    started = perf_counter()
    results.parent.mkdir(parents=True, exist_ok=True)
    try:
        results.parent.chmod(0o700)
    except OSError:
        # On Gradescope the folder may be somebody else's, who has to keep others out.
        if not on_gradescope:
            raise
    shut_in = sandbox(secrets=secrets) if options.trust_submissions else protected(secrets)
    student = _student(options.root / "submission_metadata.json") if on_gradescope else ""
    folder = options.root / ("submission" if on_gradescope else "student")
    done: list[Result] = []

    def write(report: Report) -> None:
        report = replace(report, remarks=submission.remarks)
        document = gradescope(report) if on_gradescope else prairielearn(report)
        if on_gradescope:
            document["execution_time"] = round(perf_counter() - started, 3)
        with replacing(results) as temporary:
            temporary.write_bytes(json_bytes(document))

    def write_until_now(*more: Result) -> None:
        done.extend(more)
        known = (*done, *unreached(modules, done))
        protections = shut_in.protections
        write(Report(student, known, protections=protections, seed=seed, version=__version__))

    submission = read_one(student, folder.resolve(), modules)
    if submission.trouble:
        write(troubled(student, submission.trouble, seed))
        return
    if on_gradescope:
        write_until_now()
    report = grade(
        submission.sources,
        _references(options.references, seed),
        seed=seed,
        modules=modules,
        student=student,
        limits=Limits(call_seconds=CALL_SECONDS, submission_seconds=options.seconds),
        shut_in=shut_in,
        each=write_until_now if on_gradescope else None,
    )
    write(report)
    for result in report.broken:
        # What is printed here only instructors see.
        sys.stderr.write(f"{result.id} broke:\n{result.instructor}\n")


def unreached(modules: Sequence[str], done: Iterable[Result]) -> tuple[Result, ...]:
    """Results of the checks that are not among those done: not attempted."""
    ids = {result.id for result in done}
    all_results = (
        result_of(module, check, Status.NOT_ATTEMPTED, found=NOT_REACHED)
        for module in with_whole(modules)
        for check in module_checks(module).checks
    )
    return tuple(result for result in all_results if result.id not in ids)


def _references(path: Path, seed: int) -> References:
    """The references that came with the bundle, or made now."""
    try:
        return read_references(path, seed)
    except CourseError:
        return references(seed)


def _student(path: Path) -> str:
    """Names of those who have handed it in; empty if nobody says."""
    try:
        metadata: Any = json.loads(path.read_text(encoding="utf-8"))
        users = [user.get("name") or user.get("email") or "" for user in metadata["users"]]
        return ", ".join(str(user) for user in users if user)
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return ""


if __name__ == "__main__":
    sys.exit(main())
