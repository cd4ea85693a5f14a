"""A report in the format of PrairieLearn's external graders."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from course.grading.checks.result import Status
from course.grading.report import Report, docs_page, reproduce
from course.grading.reports.drawing import draw
from course.grading.reports.grouping import explained
from course.grading.reports.text import clean, finite

IMAGES_BYTES = 500_000
"""All pictures together: PrairieLearn takes no results above 1 MB."""

ENLARGED = 320
"""Pixels across that small pictures are enlarged to; PrairieLearn shows them as large as they are."""


def results(report: Report) -> dict[str, Any]:
    """What PrairieLearn reads; a submission that could not be graded is not gradable and says why."""
    if report.trouble:
        message = f"This submission could not be graded: {report.trouble}"
    else:
        message = (
            f"{report.count(Status.PASSED)} of {len(report.results)} checks passed, "
            f"seed {report.seed}, version {report.version}."
        )
    printed = "\n".join(
        f"{module}.py printed:\n{text}" for module, text in report.printed.items() if text.strip()
    )
    return {
        "gradable": not report.trouble,
        "score": min(1.0, max(0.0, finite(report.score))),
        "message": clean(message),
        "output": clean(printed),
        "images": list(_images(report)),
        "tests": [
            {
                "name": clean(result.id),
                "description": clean(result.title),
                "points": finite(result.points),
                "max_points": finite(result.of),
                "message": "" if result.status is Status.PASSED else str(result.status),
                "output": ""
                if result.status is Status.PASSED
                else clean(
                    f"{explained(result)}\nagain: {reproduce(result, report.seed)}\n"
                    f"read: {docs_page(result)}"
                ),
            }
            for result in report.results
        ],
    }


def _images(report: Report) -> Iterator[dict[str, str]]:
    left = IMAGES_BYTES
    for result in report.results:
        if result.status is Status.PASSED:
            continue
        for figure in result.figures:
            drawing = draw(figure)
            for panel in drawing.panels:
                url = panel.data_uri(max(1, ENLARGED // max(1, panel.size[0])))
                if len(url) > left:
                    return
                left -= len(url)
                yield {
                    "label": clean(f"{result.id}: {drawing.title}: {panel.title}"),
                    "url": url,
                }
