"""The glossary: a list in Markdown becomes Sphinx's own, and a search for a term leads to the page that explains it.

In ``docs/glossary.md`` a line is ``- **Term**, **synonym**: what it means``. Its first link to a page that teaches says
where it is explained: there the terms become entries of the index, which the site's search prefers. `SOUGHT` has words
that are no terms.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

FILE = Path(__file__).parents[1] / "glossary.md"

ENTRY = re.compile(r"^- (\*\*.+?\*\*): (.*(?:\n  .*)*)\n", re.MULTILINE)
LINK = re.compile(r"\]\((modules/\w+|accuracy|architecture)\.md(?:#([\w-]+))?\)")

SOUGHT = {
    ("guides/start", "get-the-course"): ("install", "installation", "download"),
    ("guides/start", "two-commands"): ("Windows", "macOS", "Linux", "setup", "requirements"),
    ("guides/teaching", "six-weeks-the-core"): ("syllabus", "schedule", "curriculum"),
}
"""Page and heading -> what readers look for there, though it is no term of the course."""


@dataclass(frozen=True)
class Entry:
    """A line of the glossary.

    Attributes
    ----------
    terms : the term, and its synonyms
    meaning : Markdown of one paragraph
    page, place : the page that explains it, and the heading there; "" for none, or for the page as a whole
    """

    terms: tuple[str, ...]
    meaning: str
    page: str
    place: str


@lru_cache(maxsize=4)
def entries(text: str) -> tuple[Entry, ...]:
    """Read the entries of the page, in their order."""
    return tuple(_entry(match) for match in ENTRY.finditer(text))


def _entry(match: re.Match[str]) -> Entry:
    terms, meaning = match.groups()
    link = None if "*Named only" in meaning else LINK.search(meaning)
    page, place = (link[1], link[2] or "") if link else ("", "")
    meaning = " ".join(meaning.split())
    return Entry(tuple(re.findall(r"\*\*(.+?)\*\*", terms)), meaning, page, place)


def directives(text: str) -> str:
    """Return the page with a directive in the place of each list."""
    lists = re.compile(rf"(?:{ENTRY.pattern})+", re.MULTILINE)
    return lists.sub(lambda match: "\n".join(_directive(match.group())) + "\n", text)


def _directive(items: str) -> Iterator[str]:
    yield "```{glossary}"
    for entry in entries(items):
        yield from entry.terms
        yield f"  {entry.meaning}\n"
    yield "```"


def indexed(page: str, text: str) -> str:
    """Return a page, called as in ``docs`` without its suffix, with entries of the index where it explains a term."""
    found: dict[str, list[str]] = {}
    for entry in entries(FILE.read_text(encoding="utf-8")):
        if entry.page == page:
            found.setdefault(entry.place, []).extend(entry.terms)
    for (where, place), words in SOUGHT.items():
        if where == page:
            found.setdefault(place, []).extend(words)

    def mark(match: re.Match[str]) -> str:
        # The page as a whole is meant by its title; a comment in code begins like one, but not the text.
        title = match.start() == 0
        terms = found.get("" if title else slug(match[2]), [])
        if not terms or (match[1] == "#") != title:
            return match.group()
        directive = "```{index} " + ", ".join(f"! {term}" for term in terms) + "\n```\n"
        # Before a heading, so that whoever comes sees it; the title has to be the page's first line.
        return f"{match.group()}\n\n{directive}" if title else directive + match.group()

    return re.sub(r"^(##?) (.+)$", mark, text, flags=re.MULTILINE)


def slug(heading: str) -> str:
    """What links call a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
