"""The HTML pages' templates: everything that they print is cleaned and escaped."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup, escape

from course.grading.reports.text import clean


def render(template: str, **values: Any) -> str:
    """A whole page of a template beside this file."""
    return _environment().get_template(template).render(**values)


@lru_cache(maxsize=1)
def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader("course.grading.reports", ""),
        autoescape=True,
        undefined=StrictUndefined,
        finalize=_finalize,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["number"] = lambda value: f"{value:.6g}"
    environment.filters["percent"] = lambda value: f"{100 * value:.0f}\N{NO-BREAK SPACE}%"
    environment.filters["plural"] = lambda number, noun: (
        f"{number} {noun}{'' if number == 1 else 's'}"
    )
    environment.filters["marked"] = _marked
    return environment


def _marked(text: str) -> Markup:
    """Escaped, and `names` between backticks as code."""
    return Markup(re.sub(r"`([^`\n]+)`", r"<code>\1</code>", str(escape(clean(text)))))


def _finalize(value: Any) -> Any:
    if isinstance(value, Markup):
        return value
    return clean(value) if isinstance(value, str) else value
