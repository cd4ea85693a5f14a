"""A report as JUnit XML, which every service of continuous integration shows."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as ET

from course.atomic import write_text
from course.grading.checks.result import Result, Status
from course.grading.report import Report, docs_page, ending, reproduce, unstarted
from course.grading.reports.grouping import ModuleResults, explained, grouped
from course.grading.reports.text import clean, finite

_ERRORS = (Status.TIMEOUT, Status.CRASHED, Status.GRADER_ERROR)


def write_junit(report: Report, path: Path) -> None:
    """Write the XML file.

    Raises
    ------
    OutputError
        The file can't be written.
    """
    write_text(path, as_xml(report))


def as_xml(report: Report) -> str:
    """A test suite for each module and a test case for each check; not attempted is skipped."""
    suites = [_suite(module, report) for module in grouped(report)]
    if report.trouble:
        suite = _element("testsuite", name="submission", tests=1, failures=0, errors=1, skipped=0)
        case = _element("testcase", suite, classname="submission", name="can be graded")
        _element("error", case, type="not graded", message=report.trouble)
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
    statuses = [result.status for result in results]
    suite = _element(
        "testsuite",
        name=module.name,
        tests=len(results),
        failures=sum(_tag(result) == "failure" for result in results),
        errors=sum(_tag(result) == "error" for result in results),
        skipped=statuses.count(Status.NOT_ATTEMPTED),
        time=finite(sum(result.seconds for result in results)),
    )
    properties = _element("properties", suite)
    if report.seed is not None:
        _element("property", properties, name="seed", value=report.seed)
    _element("property", properties, name="version", value=report.version)
    for result in results:
        _case(suite, result, report.seed)
    printed = report.printed.get(module.name, "")
    if printed.strip():
        _element("system-out", suite).text = clean(printed)
    return suite


def _case(suite: ET.Element, result: Result, seed: int | None) -> None:
    case = _element(
        "testcase",
        suite,
        classname=f"{result.module}.{result.function}",
        name=f"{result.check}: {result.title}",
        time=finite(result.seconds),
    )
    if result.status is Status.PASSED:
        return
    if result.status is Status.NOT_ATTEMPTED:
        _element("skipped", case, message=unstarted(result) or "not attempted")
        return
    message = result.says or (
        f"expected {result.expected}, found {result.found}" if result.expected else result.found
    )
    kind = result.mistake or ending(result)
    trouble = _element(_tag(result), case, type=kind, message=message)
    trouble.text = clean(
        f"{explained(result)}\nagain: {reproduce(result, seed)}\nread: {docs_page(result)}"
    )


def _tag(result: Result) -> str:
    """What a test case that didn't pass holds; empty for one that did, or wasn't made."""
    if result.status in (Status.PASSED, Status.NOT_ATTEMPTED):
        return ""
    return "error" if result.broken or result.status in _ERRORS else "failure"


def _element(tag: str, parent: ET.Element | None = None, **attributes: object) -> ET.Element:
    values = {name: clean(str(value)) for name, value in attributes.items()}
    return ET.Element(tag, values) if parent is None else ET.SubElement(parent, tag, values)
