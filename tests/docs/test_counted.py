"""What pages count or list of the course is what the code has: modules, functions, layers, known submissions."""

import re
from functools import cache
from pathlib import Path

import pytest
from sitebuild.cards import module_pages
from sitebuild.place import Place

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE, FURTHER, MODULES
from course.engine.functions.signatures import CONTRACTS
from course.school.grading.known import known
from tests.test_layers import floors

DOCS = PROJECT / "docs"

WORDS = {
    "three": 3,
    "six": 6,
    "seven": 7,
    "fifteen": 15,
    "sixteen": 16,
    "seventeen": 17,
    "eighteen": 18,
    "nineteen": 19,
    "twenty": 20,
    "thirty": 30,
}
"""Numbers that pages write as words."""


def text_of(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def number(word: str) -> int:
    return int(word) if word.isdigit() else WORDS[word.lower()]


def test_the_readme_lists_every_module() -> None:
    text = text_of(PROJECT / "README.md")
    listed = re.findall(r"^\| \[(\w+)\]\(docs/modules/\1\.md\)", text, re.MULTILINE)
    assert sorted(listed) == sorted(COURSE)


def test_the_site_lists_the_modules_in_their_order(tmp_path: Path) -> None:
    pages = module_pages(Place("", False, tmp_path, {}))
    listed = re.findall(r":caption: (.*)|^modules/(\w+)$", pages, re.MULTILINE)
    further = [module for module in FURTHER if module != "sampling"]
    assert [caption or module for caption, module in listed] == [
        *("The warm-up", "sampling", "The six core modules", *MODULES),
        *("Further modules", *further),
    ]
    assert len(MODULES) == number("six")
    assert "<!-- site: module_pages -->" in text_of(DOCS / "index.md")


def test_the_page_tells_every_room() -> None:
    rows = re.findall(r"^\| (`[\w/`, ]+`) \|", text_of(DOCS / "architecture.md"), re.MULTILINE)
    told = re.findall(r"`([\w/]+)`", " ".join(rows))
    inner = {wing: set(floors(f"course.{wing}")) for wing in ("engine", "school")}
    rooms = {name for name in floors("course") if not name.startswith("__")} - inner.keys()
    rooms |= {f"{wing}/{name}" for wing, names in inner.items() for name in names}
    assert sorted(told) == sorted(rooms)


def test_contracts_are_of_functions_of_the_course() -> None:
    functions = [f"{module}.{name}" for module in COURSE for name in COURSE[module]]
    assert set(CONTRACTS) < set(functions)


@cache
def kept() -> dict[str, list[bool]]:
    """Whether they are right, of the known submissions of each module."""
    return {module: [each.right for each in known(module)] for module in COURSE}


@pytest.mark.parametrize(
    "page", ["CONTRIBUTING.md", "docs/grading.md", "docs/guides/new_module.md"]
)
def test_modules_have_as_many_known_submissions_as_pages_say(page: str) -> None:
    paper = " ".join(text_of(PROJECT / "paper" / "paper.md").split())
    (published,) = re.findall(r"wrong submissions, at least (\w+) for each module", paper)
    text = " ".join(text_of(PROJECT / page).split())
    rights = re.findall(r"(?:at least )?(\w+) right ones", text)
    wrongs = re.findall(r"(\w+) (?:wrong ones|submissions with typical mistakes)", text)
    for words, right in ((rights, True), (wrongs, False)):
        (least,) = {number(word) for word in words if word.lower() in WORDS}
        for module, found in kept().items():
            assert found.count(right) >= least, module
    assert least == number(published)
