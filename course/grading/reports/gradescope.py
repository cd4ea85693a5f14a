"""A report in the format of Gradescope's ``results.json``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from course.grading.checks.result import Result, Status
from course.grading.report import (
    Report,
    as_points,
    broke,
    docs_page,
    ending,
    for_students,
    reproduce,
)
from course.grading.reports.grouping import explained, grouped
from course.grading.reports.text import clean, finite


def results(report: Report) -> dict[str, Any]:
    """What Gradescope reads.

    A check that was not attempted is a failed test with 0 points: left out, it would raise the score. Students read
    this file, so a hidden seed is left out.
    """
    report = for_students(report)
    if report.trouble:
        output = f"This submission could not be graded: {report.trouble}"
    else:
        output = (
            f"{report.count(Status.PASSED)} of {len(report.results)} checks passed, "
            f"{as_points(report.points)} of {as_points(report.of)} points.{broke(report)}"
        )
    output = "\n".join(filter(None, (report.unprotected, output)))
    return {
        "score": finite(report.points),
        "execution_time": finite(report.seconds),
        "output": clean(output),
        "output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "extra_data": {"version": clean(report.version)},
        "tests": list(_tests(report)),
    }


def _tests(report: Report) -> Iterator[dict[str, Any]]:
    for m, module in enumerate(grouped(report), 1):
        for f, function in enumerate(module.functions, 1):
            for c, result in enumerate(function.results, 1):
                yield {
                    "score": finite(result.points),
                    "max_score": finite(result.of),
                    # A grader's error has its points, and is marked nonetheless: nobody has seen it pass.
                    "status": "passed" if result.status is Status.PASSED else "failed",
                    "name": clean(f"{module.name}.{function.name}: {result.title}"),
                    "number": f"{m}.{f}.{c}",
                    "output": clean(_output(result, report.seed)),
                    "output_format": "text",
                    "tags": [clean(module.name), clean(function.name), clean(result.kind)],
                    "visibility": "visible",
                    "extra_data": {
                        "id": clean(result.id),
                        "status": str(result.status),
                        "mistake": clean(result.mistake),
                    },
                }


def _output(result: Result, seed: int | None) -> str:
    if result.status is Status.PASSED:
        return ""
    lines = [] if ending(result) == Status.FAILED else [ending(result)]
    lines += [explained(result)] if explained(result) else []
    return "\n".join([*lines, f"again: {reproduce(result, seed)}", f"read: {docs_page(result)}"])
