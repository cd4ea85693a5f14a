"""Docstrings as the course writes them, with sections underlined and an argument to a line, as reStructuredText."""

import re
from collections.abc import Iterator
from typing import Any

from sphinx.application import Sphinx

NAMED = ("Parameters", "Attributes")
"""Sections whose items are ``name : what it is``."""

TYPE = 80
"""Characters: lines that are shorter were not broken because they were full."""

LITERAL = re.compile(r"(`+)(.+?)\1")


def connect(app: Sphinx) -> None:
    """Let autodoc hand docstrings over."""
    app.connect("autodoc-process-docstring", _process)


def _process(*event: Any) -> None:
    # What is documented, and how, comes before the lines.
    lines = event[-1]
    lines[:] = restructured(lines)


def restructured(lines: list[str]) -> list[str]:
    """Translate the lines of a docstring; an empty line ends them."""
    title, body, out = "", list[str](), list[str]()
    for number, line in enumerate([*lines, ""]):
        below = lines[number + 1] if number + 1 < len(lines) else ""
        if line and re.fullmatch("-{3,}", below):
            out += _section(title, body)
            title, body = line, []
        elif not (title and not body and re.fullmatch("-{3,}", line)):
            body.append(line)
    return [*out, *_section(title, body)]


def _section(title: str, body: list[str]) -> Iterator[str]:
    if title:
        yield from (f"**{title}**", "")
    if not any(line.startswith(" ") for line in body) and title not in NAMED:
        yield from _paragraphs(body)
        return
    items: list[list[str]] = []
    for line in body:
        if line and not line.startswith(" "):
            items.append([line])
        elif line and items:
            items[-1].append(line.strip())
    for head, *rest in items:
        term, _, first = head.partition(" : ") if title in NAMED else (head, "", "")
        yield f"``{term}``" if title in NAMED else _escaped(term)
        # A short first line is a type, what is below it a sentence of its own.
        between = ". " if first and rest and len(head) < TYPE and rest[0][0].isupper() else " "
        told = between.join(part for part in (first, " ".join(rest)) if part)
        yield f"   {_escaped(told) or '..'}"
        yield ""


def _paragraphs(body: list[str]) -> Iterator[str]:
    """Yield each paragraph on one line, so that no literal is broken."""
    for paragraph in "\n".join(body).strip("\n").split("\n\n"):
        yield from (_escaped(" ".join(paragraph.split())), "")


def _escaped(text: str) -> str:
    """Take what isn't code literally: bars, stars and underscores mean something else there."""
    out, end = [], 0
    for match in LITERAL.finditer(text):
        out += [_plain(text[end : match.start()]), f"``{match.group(2)}``"]
        end = match.end()
    return "".join([*out, _plain(text[end:])])


def _plain(text: str) -> str:
    return re.sub(r"([\\*|]|_\b)", r"\\\1", text)
