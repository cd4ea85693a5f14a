"""What a page shows as code: commands, scenes and parts of scenes, Python; in the order in which it shows them."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

PROGRAMS = r"course|make|python3?|py|pip|apt|source|\.venv[\\/](?:bin|Scripts)[\\/]\w+"
COMMAND = re.compile(rf"(?:{PROGRAMS})(?: |$)")
INLINE = re.compile(r"`([^`\n]+)`")
ACTIVATE = re.compile(r"\.venv\\Scripts\\activate")

DIRECTIVES = ("{toctree}", "{eval-rst}")
"""Fences that are no code but words to the build of the site, which fails if it can't read them."""


@dataclass(frozen=True)
class Block:
    """Code on a page.

    Attributes
    ----------
    kind : "command" (one line), "inline" (a command within a sentence), "python", "yaml", or what the fence says
    text : the code
    line : of the page, counted from 1
    before : the paragraph above it
    """

    kind: str
    text: str
    line: int
    before: str


def blocks(path: Path) -> list[Block]:
    """Return all code of a page that somebody could type, in order."""
    return [*_blocks(path.read_text(encoding="utf-8").splitlines())]


def _blocks(lines: list[str]) -> Iterator[Block]:
    paragraph: list[str] = []
    number = 0
    while number < len(lines):
        line = lines[number]
        start = number + 1
        fence = re.fullmatch(r"```(\S*)", line)
        if fence:
            end = lines.index("```", start)
            yield from _fenced(fence[1], lines[start:end], start + 1, _last(paragraph))
            number = end + 1
        elif line.startswith("    "):
            end = number
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            code = [each[4:] for each in lines[number:end]]
            yield from _indented(code, start, _last(paragraph))
            number = end
        else:
            for match in INLINE.finditer(line):
                if re.match(rf"(?:{PROGRAMS}) ", match[1]) or ACTIVATE.fullmatch(match[1]):
                    yield Block("inline", match[1], start, "")
            paragraph.append(line)
            number += 1


def _last(paragraph: list[str]) -> str:
    """The last paragraph of what was read."""
    return "\n".join(paragraph).strip().rpartition("\n\n")[2]


def _fenced(kind: str, code: list[str], line: int, before: str) -> Iterator[Block]:
    if kind in ("sh", "bash", "console", "shell"):
        yield from _commands(code, line, before)
    elif kind not in DIRECTIVES:
        yield Block(kind, "\n".join(code) + "\n", line, before)


def _indented(code: list[str], line: int, before: str) -> Iterator[Block]:
    if COMMAND.match(code[0]):
        yield from _commands(code, line, before)
    else:
        text = "\n".join(code).rstrip() + "\n"
        yield Block("yaml" if _is_yaml(text) else "python", text, line, before)


def _commands(code: list[str], line: int, before: str) -> Iterator[Block]:
    for number, each in enumerate(code):
        if each.strip():
            yield Block("command", each.strip(), line + number, before)


def _is_yaml(text: str) -> bool:
    """Whether it is a map with plain names as keys, or a list: Python has neither at its beginning."""
    try:
        found: Any = yaml.safe_load(text)
    except yaml.YAMLError:
        return False
    if isinstance(found, dict):
        return all(re.fullmatch(r"\w+", str(key)) for key in found)
    return isinstance(found, list)
