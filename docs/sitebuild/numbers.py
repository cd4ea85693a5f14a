"""Numbers in tables that no line ends within: not after the hyphen of 2.1e-03, nor inside a range or behind a ≤."""

import re

from docutils import nodes
from sphinx.application import Sphinx

UNBROKEN = re.compile(
    r"\(?\S+ \.\. \S+"  # a range
    r"|\(\d+, \d+\)"  # a pixel
    r"|[≤≥] \S+"  # a bound
    r"|\S*\de[-+]\d+\S*"  # a number with an exponent
    r"|\(?[-+]\d\S*"  # a number with a sign
)


def connect(app: Sphinx) -> None:
    """Join them once a page is complete."""
    app.connect("doctree-resolved", lambda *event: join_numbers(event[1]))


def join_numbers(doctree: nodes.Node) -> None:
    """Put what is not to be broken into an inline of the class that style sheets keep in one line."""
    for entry in doctree.findall(nodes.entry):
        for text in list(entry.findall(nodes.Text)):
            # Code has its own form.
            if isinstance(text.parent, nodes.paragraph):
                text.parent.replace(text, _parts(text.astext()))


def _parts(text: str) -> list[nodes.Node]:
    parts: list[nodes.Node] = []
    end = 0
    for found in UNBROKEN.finditer(text):
        if before := text[end : found.start()]:
            parts.append(nodes.Text(before))
        parts.append(nodes.inline("", found.group(), classes=["joined"]))
        end = found.end()
    return [*parts, nodes.Text(text[end:])]
