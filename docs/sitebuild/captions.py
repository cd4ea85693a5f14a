"""Captions of the site's menu, which the theme calls headings without saying of which level."""

from typing import Any

from sphinx.application import Sphinx

AFTER_THE_THEME = 900
"""Later than 500, at which the theme makes its menu."""


def connect(app: Sphinx) -> None:
    """Say the level before a page is written."""
    app.connect("html-page-context", _say_level, priority=AFTER_THE_THEME)


def _say_level(*given: Any) -> None:
    """Take what Sphinx gives: itself, the page's name, its template, and what the template is told."""
    context = given[3]
    menu = context.get("furo_navigation_tree")
    if menu:
        context["furo_navigation_tree"] = menu.replace(
            'role="heading">', 'role="heading" aria-level="2">'
        )
