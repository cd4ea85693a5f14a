"""HTML pages that need nothing else, no network and no other file; and a student's report as one of them.

The only script is that of views of rays. Everything that the templates print is cleaned and escaped.
"""

import re
from functools import lru_cache
from itertools import count
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from course.base.texts import clean
from course.school.grading.checks.result import Result, Status
from course.school.grading.report import (
    Report,
    as_points,
    docs_page,
    ending,
    findings,
    grouped,
    reproduce,
    unstarted,
)
from course.school.grading.reports.order import place


def as_page(report: Report) -> str:
    """A student's report as a page; figures are drawn for the checks that didn't pass."""
    from course.engine.recording.view import script, script_hash, style
    from course.school.grading.reports.drawing import draw, is_noisy, with_own_ids

    modules = sorted(grouped(report), key=lambda module: place(module.name))
    plots = count(1)
    return render(
        "page.html.jinja",
        report=report,
        modules=modules,
        undecided=any(module.count("undecided") for module in modules),
        names={module.name for module in modules},
        counts=[(str(status), report.count(status)) for status in Status if report.count(status)],
        drawings=lambda result: [draw(figure, noisy=is_noisy(result)) for figure in result.figures],
        # Made here from numbers and the scenes' own names: the view's data are text to the page.
        as_markup=Markup,
        rays={"style": Markup(style()), "script": Markup(script()), "hash": Markup(script_hash())}
        if any(_shows_rays(result) for result in report.results)
        else None,
        # Made here from numbers: nothing of a student's text is in it.
        plot=lambda svg: Markup(with_own_ids(svg, f"p{next(plots)}")),
        reproduce=reproduce,
        docs_page=docs_page,
        findings=findings,
        unstarted=unstarted,
        ending=ending,
    )


def _shows_rays(result: Result) -> bool:
    return result.status is not Status.PASSED and any(f.kind == "rays" for f in result.figures)


def render(template: str, **values: Any) -> str:
    """A whole page of a template beside this file."""
    return _environment().get_template(template).render(**values)


@lru_cache(maxsize=1)
def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("course.school.grading.reports", ""),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=lambda value: (
            clean(value) if isinstance(value, str) and not isinstance(value, Markup) else value
        ),
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {
        "number": as_points,
        "percent": lambda value: f"{100 * value:.0f}\N{NO-BREAK SPACE}%",
        "plural": lambda number, noun: f"{number} {noun}{'' if number == 1 else 's'}",
        "marked": _marked,
    }
    return environment


def _marked(text: str) -> Markup:
    """Escaped, and `names` between backticks as code."""
    return Markup(re.sub(r"`([^`\n]+)`", r"<code>\1</code>", str(escape(clean(text)))))
