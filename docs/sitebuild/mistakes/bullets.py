"""The list of common mistakes in a function's section of its module's page."""

import re
from dataclasses import dataclass

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT


@dataclass(frozen=True)
class Bullet:
    """One mistake of a list, in Markdown.

    Attributes
    ----------
    title : the words that stand out, with their full stop
    text : the rest, in one line
    """

    title: str
    text: str


def bullets(function: str) -> list[Bullet]:
    """Read the list of MODULE.FUNCTION.

    Raises
    ------
    CourseError
        The page has no such section, or no list in it.
    """
    module, _, name = function.partition(".")
    path = PROJECT / "docs" / "modules" / f"{module}.md"
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    section = re.search(rf"^## {name}\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    found = section and re.search(
        r"^Common mistakes:\n\n((?:- .*\n(?: {2}.*\n)*)+)", section[1], re.MULTILINE
    )
    if not found:
        raise CourseError(f"{path} has no list of common mistakes in a section {name!r}")
    items = [" ".join(item.split()) for item in re.split(r"^- ", found[1], flags=re.MULTILINE)[1:]]
    return [_bullet(item) for item in items]


def _bullet(item: str) -> Bullet:
    found = re.match(r"\*(.+?)\*(.*)", item)
    if not found:
        raise CourseError(f"a common mistake without a title in *asterisks*: {item}")
    return Bullet(f"{found[1].rstrip('.')}.", found[2].lstrip(" ,."))


def plain(markdown: str) -> str:
    """Without the marks of Markdown and TeX, for those who have a text read aloud."""
    without_links = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", markdown)
    return re.sub(r"\\\w+|[$`*\\{}]", "", without_links).strip()
