"""Grade the one submission that Gradescope has put into its container: ``run_autograder`` runs this.

Gradescope ends what takes longer than its limit, so the results are written anew after every check: what has been
earned until then counts. Whatever has not been reached stands in them with its points to earn.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import sys
import traceback
from collections.abc import Iterable, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any

from course import __version__
from course.atomic import replacing
from course.errors import CourseError
from course.grading.catalog import module_checks
from course.grading.checks.preparing import References
from course.grading.checks.result import Result, Status
from course.grading.classes.bundle import REFERENCES
from course.grading.classes.job import troubled, with_whole
from course.grading.classes.submitted import read_one
from course.grading.grading import grade
from course.grading.references import read_references, references
from course.grading.report import Report
from course.grading.reports.formats import gradescope, json_bytes
from course.grading.worker.limits import Limits
from course.grading.worker.sandbox import NotProtected, protected, sandbox
from course.modules import COURSE

LIMITS = Limits(call_seconds=20.0)
"""Half a core, as Gradescope gives it, takes twice the time."""

NOT_REACHED = "the time was over before this check"


def main(arguments: Sequence[str] | None = None) -> int:
    """Grade ROOT/submission into ROOT/results/results.json; 0, or 1 after a fault of the grader.

    Parameters
    ----------
    arguments : of the command line; this process's if not given
    """
    parser = argparse.ArgumentParser(prog="run_autograder", description="Grade on Gradescope.")
    parser.add_argument("--root", type=Path, default=Path("/autograder"))
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--modules", default=",".join(COURSE))
    parser.add_argument("--trust-submissions", action="store_true")
    parser.add_argument("--walls", action="store_true", help="only say what keeps submissions in")
    options = parser.parse_args(arguments)
    if options.walls:
        return _tell_walls(options.root)
    writer = _Writer(
        options.root / "results" / "results.json",
        _student(options.root / "submission_metadata.json"),
        options.seed,
        options.modules.split(","),
    )
    try:
        return _grade(options.root, writer, trusted=options.trust_submissions)
    except Exception:  # noqa: BLE001 - whatever it is, it is no mistake of the student's
        traceback.print_exc()
        # Without results Gradescope says that the autograder has failed; with some, they would be a grade.
        writer.remove()
        return 1


def _tell_walls(root: Path) -> int:
    """Say when the image is built what would otherwise be found out by the first submission."""
    try:
        protections = protected(_secrets(root)).protections
    except NotProtected as error:
        protections = (f"Submissions will not be graded: {error}",)
    sys.stdout.write("\n".join((*protections, "")))
    return 0


def _secrets(root: Path) -> tuple[Path, ...]:
    """What students' code must not read: there is no other submission, and the solutions are known."""
    return (root / "results", root / "source" / REFERENCES)


def _grade(root: Path, writer: _Writer, *, trusted: bool) -> int:
    writer.close()
    shut_in = sandbox(secrets=_secrets(root)) if trusted else protected(_secrets(root))
    writer.protections = shut_in.protections
    submission = read_one(writer.student, (root / "submission").resolve(), writer.modules)
    if submission.trouble:
        writer.fail(submission.trouble)
        return 0
    writer.write(None)
    report = grade(
        submission.sources,
        _references(root / "source" / REFERENCES, writer.seed),
        seed=writer.seed,
        modules=writer.modules,
        student=writer.student,
        limits=LIMITS,
        shut_in=shut_in,
        each=writer.add,
    )
    writer.write(report)
    for result in report.broken:
        # What is printed here only instructors see.
        sys.stderr.write(f"{result.id} broke:\n{result.instructor}\n")
    return 0


class _Writer:
    """Keeps results.json what is known so far."""

    def __init__(self, path: Path, student: str, seed: int, modules: Sequence[str]) -> None:
        self.student, self.seed, self.modules = student, seed, modules
        self._path = path
        self._started = perf_counter()
        self._results: list[Result] = []
        self.protections: tuple[str, ...] = ()

    def close(self) -> None:
        """Keep the folder of the results from everybody else; where it isn't ours, others must do that."""
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with contextlib.suppress(OSError):
            self._path.parent.chmod(0o700)

    def add(self, result: Result) -> None:
        """Write with one result more."""
        self._results.append(result)
        self.write(None)

    def fail(self, trouble: str) -> None:
        """Write why there are no results."""
        self.write(troubled(self.student, trouble, self.seed))

    def remove(self) -> None:
        """Leave no results."""
        self._path.unlink(missing_ok=True)

    def write(self, report: Report | None) -> None:
        """Write a report, or what it will be if no more comes."""
        if report is None:
            all_results = (*self._results, *unreached(self.modules, self._results))
            report = Report(
                self.student,
                all_results,
                protections=self.protections,
                seed=self.seed,
                version=__version__,
            )
        seconds = round(perf_counter() - self._started, 3)
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(self._path) as temporary:
            temporary.write_bytes(json_bytes(gradescope(report) | {"execution_time": seconds}))


def unreached(modules: Sequence[str], done: Iterable[Result]) -> tuple[Result, ...]:
    """Results of the checks that are not among those done: not attempted."""
    ids = {result.id for result in done}
    return tuple(
        Result(
            module,
            check.function,
            check.name,
            check.title,
            check.kind,
            Status.NOT_ATTEMPTED,
            0.0,
            check.points,
            found=NOT_REACHED,
        )
        for module in with_whole(modules)
        for check in module_checks(module).checks
        if f"{module}.{check.function}/{check.name}" not in ids
    )


def _references(path: Path, seed: int) -> References:
    """Those that came with the bundle, or made now."""
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
