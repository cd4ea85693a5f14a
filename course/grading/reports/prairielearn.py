"""A report in the format of PrairieLearn's external graders."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from course.grading.checks.result import Status
from course.grading.report import Report, broke, docs_page, ending, for_students, reproduce
from course.grading.reports.drawing import draw
from course.grading.reports.grouping import explained
from course.grading.reports.text import clean, finite

IMAGES_BYTES = 500_000
"""All pictures together: PrairieLearn takes no results above 1 MB."""

TEXT_BYTES = 300_000
"""What all checks have to say together, as JSON."""

LONGEST = 4000
"""Characters that one check has to say."""

_NO_ROOM = (
    "what was found is left out, for PrairieLearn takes no more; the next line finds it again"
)

ENLARGED = 320
"""Pixels across that small pictures are enlarged to; PrairieLearn shows them as large as they are."""


def results(report: Report) -> dict[str, Any]:
    """What PrairieLearn reads; a submission that could not be graded is not gradable and says why.

    Students read this file, so a hidden seed is left out.
    """
    report = for_students(report)
    if report.trouble:
        message = f"This submission could not be graded: {report.trouble}"
    else:
        message = (
            f"{report.count(Status.PASSED)} of {len(report.results)} checks passed, "
            f"{'' if report.seed is None else f'seed {report.seed}, '}version {report.version}.{broke(report)}"
        )
    message = "\n".join(filter(None, (report.unprotected, message)))
    printed = "\n".join(
        f"{module}.py printed:\n{text}" for module, text in report.printed.items() if text.strip()
    )
    return {
        "gradable": not report.trouble,
        "format_errors": [clean(report.trouble)] if report.trouble else [],
        "score": min(1.0, max(0.0, finite(report.score))),
        "message": clean(message),
        "output": clean(printed),
        "images": list(_images(report)),
        "tests": list(_tests(report)),
    }


def _tests(report: Report) -> Iterator[dict[str, Any]]:
    left = TEXT_BYTES
    for result in report.results:
        output = ""
        if result.status is not Status.PASSED:
            lines = clean(f"again: {reproduce(result, report.seed)}\nread: {docs_page(result)}")
            told = clean(explained(result), LONGEST)
            size = len(json.dumps(told))
            output = f"{told if size <= left else _NO_ROOM}\n{lines}"
            left -= size if size <= left else 0
        yield {
            "name": clean(result.id),
            "description": clean(result.title),
            "points": finite(result.points),
            "max_points": finite(result.of),
            "message": "" if result.status is Status.PASSED else ending(result),
            "output": output,
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
