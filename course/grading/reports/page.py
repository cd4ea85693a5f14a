"""A student's report as one HTML page that needs nothing else: no network, no script, no other file."""

from __future__ import annotations

from itertools import count
from pathlib import Path

from markupsafe import Markup

from course.atomic import write_text
from course.grading.checks.result import Status
from course.grading.report import Report, docs_page, ending, findings, reproduce, unstarted
from course.grading.reports.drawing import draw
from course.grading.reports.grouping import grouped
from course.grading.reports.plots import with_own_ids
from course.grading.reports.templates import render


def write_page(report: Report, path: Path) -> None:
    """Write the page.

    Figures are drawn for the checks that didn't pass.

    Raises
    ------
    OutputError
        The file can't be written.
    """
    write_text(path, as_page(report))


def as_page(report: Report) -> str:
    """The page's text."""
    modules = grouped(report)
    plots = count(1)

    def plot(svg: str) -> Markup:
        # Made here from numbers: nothing of a student's text is in it.
        return Markup(with_own_ids(svg, f"p{next(plots)}"))

    return render(
        "page.html.jinja",
        report=report,
        modules=modules,
        undecided=any(module.count("undecided") for module in modules),
        names={module.name for module in modules},
        counts=[(str(status), report.count(status)) for status in Status if report.count(status)],
        draw=draw,
        plot=plot,
        reproduce=reproduce,
        docs_page=docs_page,
        findings=findings,
        unstarted=unstarted,
        ending=ending,
    )
