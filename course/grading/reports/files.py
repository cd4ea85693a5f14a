"""A report as JSON, for other programs."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from course.atomic import write_text
from course.grading.checks.result import Result, Status
from course.grading.report import Report, docs_page, reproduce
from course.grading.reports.text import clean, finite

FORMAT = 1
"""Goes up when a key changes its meaning or goes away."""


def write_json(report: Report, path: Path) -> None:
    """Write everything except the figures.

    Raises
    ------
    OutputError
        The file can't be written.
    """
    write_document(as_json(report), path)


def write_document(document: Mapping[str, Any], path: Path) -> None:
    """Write any of the reports that are dicts, such as Gradescope's.

    Raises
    ------
    OutputError
        The file can't be written.
    """
    write_text(path, json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def as_json(report: Report) -> dict[str, Any]:
    """Everything except the figures; texts are cleaned, and numbers that are none are 0."""
    return {
        "format": FORMAT,
        "student": clean(report.student),
        "version": clean(report.version),
        "seed": report.seed,
        "seconds": finite(report.seconds),
        "score": finite(report.score),
        "points": finite(report.points),
        "of": finite(report.of),
        "trouble": clean(report.trouble),
        "counts": {str(status): report.count(status) for status in Status},
        "protections": [clean(text) for text in report.protections],
        "printed": {clean(module): clean(text) for module, text in report.printed.items()},
        "results": [_result(result, report.seed) for result in report.results],
    }


def _result(result: Result, seed: int | None) -> dict[str, Any]:
    return {
        "id": clean(result.id),
        "module": clean(result.module),
        "function": clean(result.function),
        "check": clean(result.check),
        "title": clean(result.title),
        "kind": clean(result.kind),
        "status": str(result.status),
        "points": finite(result.points),
        "of": finite(result.of),
        "expected": clean(result.expected),
        "found": clean(result.found),
        "where": clean(result.where),
        "hint": clean(result.hint),
        "example": clean(result.example),
        "mistake": clean(result.mistake),
        "says": clean(result.says),
        "same_as": clean(result.same_as),
        "module_wide": result.module_wide,
        "broken": result.broken,
        "seconds": finite(result.seconds),
        "reproduce": clean(reproduce(result, seed)),
        "docs": clean(docs_page(result)),
    }
