"""A report for other programs: our own JSON, Gradescope's and PrairieLearn's results, and JUnit XML.

Texts are fit for any file, and numbers that are none are 0: student code has written some of both.
"""

import json
import math
from collections.abc import Iterator, Mapping
from typing import Any
from xml.etree import ElementTree as ET

from course.base.texts import clean
from course.school.grading.checks.result import Result, Status
from course.school.grading.report import (
    ModuleResults,
    Report,
    as_points,
    broke,
    docs_page,
    ending,
    findings,
    for_students,
    grouped,
    reproduce,
    unstarted,
)

FORMAT = 1
"""Of our own JSON; goes up when a key changes its meaning or goes away."""

IMAGES_BYTES = 500_000
"""All pictures together: PrairieLearn takes no results above 1 MB."""

TEXT_BYTES = 300_000
"""What all checks have to say together on PrairieLearn, as JSON."""

LONGEST_FINDING = 4000
"""Characters that one check has to say on PrairieLearn."""

ENLARGED = 320
"""Pixels across that small pictures are enlarged to; PrairieLearn shows them as large as they are."""

_NO_ROOM = (
    "what was found is left out, for PrairieLearn takes no more; the next line finds it again"
)
_OF_REPORTS = (
    "student",
    "version",
    "seed",
    "seconds",
    "score",
    "points",
    "of",
    "trouble",
    "remarks",
)
_OF_RESULTS = (
    *("id", "module", "function", "check", "title", "kind", "status", "points", "of"),
    *("expected", "found", "where", "hint", "example", "mistake", "says", "same_as"),
    *("module_wide", "broken", "seconds"),
)
_ERRORS = (Status.TIMEOUT, Status.CRASHED, Status.GRADER_ERROR)


def finite(number: float) -> float:
    """The number, or 0 where it is none: JSON knows neither NaN nor infinity."""
    return round(float(number), 6) if math.isfinite(number) else 0.0


def json_bytes(value: object) -> bytes:
    """As a JSON file."""
    return json.dumps(value, indent=1, allow_nan=False).encode() + b"\n"


def as_json(report: Report) -> dict[str, Any]:
    """Everything except the figures."""
    document = {
        "format": FORMAT,
        **{name: getattr(report, name) for name in _OF_REPORTS},
        "counts": {str(status): report.count(status) for status in Status},
        "protections": report.protections,
        "printed": report.printed,
        "results": [
            {name: getattr(result, name) for name in _OF_RESULTS}
            | {"reproduce": reproduce(result, report.seed), "docs": docs_page(result)}
            for result in report.results
        ],
    }
    return _fit(document)


def gradescope(report: Report) -> dict[str, Any]:
    """The ``results.json`` that Gradescope reads.

    A check that was not attempted is a failed test with 0 points: left out, it would raise the score. Students read
    this file, so a hidden seed is left out.
    """
    report = for_students(report)
    document = {
        "score": report.points,
        "execution_time": report.seconds,
        "output": _summary(report, f"{as_points(report.points)} of {as_points(report.of)} points"),
        "output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "extra_data": {"version": report.version},
        "tests": list(_gradescope_tests(report)),
    }
    return _fit(document)


def _gradescope_tests(report: Report) -> Iterator[dict[str, Any]]:
    for m, module in enumerate(grouped(report), 1):
        for f, function in enumerate(module.functions, 1):
            for c, result in enumerate(function.results, 1):
                passed = result.status is Status.PASSED
                told = [ending(result), explained(result)]
                if told[0] == Status.FAILED:
                    del told[0]
                yield {
                    "score": result.points,
                    "max_score": result.of,
                    # A grader's error has its points, and is marked nonetheless: nobody has seen it pass.
                    "status": "passed" if passed else "failed",
                    "name": f"{module.name}.{function.name}: {result.title}",
                    "number": f"{m}.{f}.{c}",
                    "output": "" if passed else _lines(*told, _again(result, report.seed)),
                    "output_format": "text",
                    "tags": [module.name, function.name, result.kind],
                    "visibility": "visible",
                    "extra_data": {
                        "id": result.id,
                        "status": result.status,
                        "mistake": result.mistake,
                    },
                }


def prairielearn(report: Report) -> dict[str, Any]:
    """The results that PrairieLearn reads of an external grader.

    A submission that could not be graded is not gradable and says why. Students read this file, so a hidden seed is
    left out.
    """
    report = for_students(report)
    seed = "" if report.seed is None else f"seed {report.seed}, "
    printed = (
        f"{module}.py printed:\n{text}" for module, text in report.printed.items() if text.strip()
    )
    document = {
        "gradable": not report.trouble,
        "format_errors": [report.trouble] if report.trouble else [],
        "score": min(1.0, max(0.0, finite(report.score))),
        "message": _summary(report, f"{seed}version {report.version}"),
        "output": "\n".join(printed),
        "images": [],
        "tests": list(_prairielearn_tests(report)),
    }
    # The pictures' addresses are longer than any text.
    return _fit(document) | {"images": list(_prairielearn_images(report))}


def _prairielearn_tests(report: Report) -> Iterator[dict[str, Any]]:
    left = TEXT_BYTES
    for result in report.results:
        passed = result.status is Status.PASSED
        told = "" if passed else clean(explained(result), LONGEST_FINDING)
        size = 0 if passed else len(json.dumps(told))
        if size > left:
            told, size = _NO_ROOM, 0
        left -= size
        yield {
            "name": result.id,
            "description": result.title,
            "points": result.points,
            "max_points": result.of,
            "message": "" if passed else ending(result),
            "output": "" if passed else f"{told}\n{_again(result, report.seed)}",
        }


def _prairielearn_images(report: Report) -> Iterator[dict[str, str]]:
    from course.school.grading.reports.drawing import draw, is_noisy

    left = IMAGES_BYTES
    for result in report.results:
        for figure in () if result.status is Status.PASSED else result.figures:
            drawing = draw(figure, noisy=is_noisy(result))
            for panel in drawing.panels:
                url = panel.data_uri(max(1, ENLARGED // max(1, panel.size[0])))
                left -= len(url)
                if left < 0:
                    return
                label = clean(f"{result.id}: {drawing.title}: {panel.title}")
                yield {"label": label, "url": url}


def as_xml(report: Report) -> str:
    """JUnit XML: a test suite for each module and a test case for each check; not attempted is skipped."""
    suites = [_suite(module, report) for module in grouped(report)]
    if report.trouble:
        suite = _element("testsuite", name="submission", tests=1, failures=0, errors=1, skipped=0)
        case = _element("testcase", suite, classname="submission", name="can be graded")
        _element("error", case, type="not graded", message=report.trouble)
        suites.append(suite)
    if report.remarks:
        suite = _element("testsuite", name="files", tests=0, failures=0, errors=0, skipped=0)
        _element("system-out", suite).text = clean("\n".join(report.remarks))
        suites.append(suite)
    name = ": ".join(filter(None, (f"Penumbra {report.student}", report.unprotected)))
    root = _element("testsuites", name=name, time=finite(report.seconds))
    for key in ("tests", "failures", "errors", "skipped"):
        root.set(key, str(sum(int(suite.get(key, "0")) for suite in suites)))
    root.extend(suites)
    ET.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def _suite(module: ModuleResults, report: Report) -> ET.Element:
    results = [result for function in module.functions for result in function.results]
    tags = [_tag(result) for result in results]
    suite = _element(
        "testsuite",
        name=module.name,
        tests=len(results),
        failures=tags.count("failure"),
        errors=tags.count("error"),
        skipped=tags.count("skipped"),
        time=finite(sum(result.seconds for result in results)),
    )
    properties = _element("properties", suite)
    if report.seed is not None:
        _element("property", properties, name="seed", value=report.seed)
    _element("property", properties, name="version", value=report.version)
    for result, tag in zip(results, tags, strict=True):
        case = _element(
            "testcase",
            suite,
            classname=f"{result.module}.{result.function}",
            name=f"{result.check}: {result.title}",
            time=finite(result.seconds),
        )
        if tag == "skipped":
            _element(tag, case, message=unstarted(result) or "not attempted")
        elif tag:
            compared = f"expected {result.expected}, found " if result.expected else ""
            message = result.says or f"{compared}{result.found}"
            trouble = _element(tag, case, type=result.mistake or ending(result), message=message)
            trouble.text = clean(f"{explained(result)}\n{_again(result, report.seed)}")
    printed = report.printed.get(module.name, "")
    if printed.strip():
        _element("system-out", suite).text = clean(printed)
    return suite


def _tag(result: Result) -> str:
    """The element in a result's test case; empty for a check that passed."""
    if result.status is Status.PASSED:
        return ""
    if result.status is Status.NOT_ATTEMPTED:
        return "skipped"
    return "error" if result.broken or result.status in _ERRORS else "failure"


def _element(tag: str, parent: ET.Element | None = None, **attributes: object) -> ET.Element:
    values = {name: clean(str(value)) for name, value in attributes.items()}
    return ET.Element(tag, values) if parent is None else ET.SubElement(parent, tag, values)


def _summary(report: Report, more: str) -> str:
    """The lines that a system shows above all tests."""
    told = f"This submission could not be graded: {report.trouble}"
    if not report.trouble:
        passed = report.count(Status.PASSED)
        told = f"{passed} of {len(report.results)} checks passed, {more}.{broke(report)}"
    return _lines(report.unprotected, told, *report.remarks)


def explained(result: Result) -> str:
    """The findings of a check that didn't pass, as lines of plain text."""
    return "\n".join(f"{label}: {text.rstrip()}" for label, text in findings(result))


def _again(result: Result, seed: int | None) -> str:
    return f"again: {reproduce(result, seed)}\nread: {docs_page(result)}"


def _lines(*texts: str) -> str:
    return "\n".join(filter(None, texts))


def _fit(document: Mapping[str, Any]) -> dict[str, Any]:
    """A document whose texts are cleaned, and whose numbers are finite."""
    return {clean(key): _fit_value(value) for key, value in document.items()}


def _fit_value(value: Any) -> Any:
    if isinstance(value, Mapping):
        return _fit(value)
    if isinstance(value, list | tuple):
        return [_fit_value(inner) for inner in value]
    if isinstance(value, float):
        return finite(value)
    return clean(value) if isinstance(value, str) else value
