"""Reports of grading send students to a heading of a page: both are there, and so are the files that are named."""

import re
from pathlib import Path

import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.school.grading.release.archive import solution_lines

PAGES = PROJECT / "docs" / "modules"


@pytest.mark.parametrize("module", COURSE)
def test_every_function_has_its_heading(module: str) -> None:
    text = (PAGES / f"{module}.md").read_text(encoding="utf-8")
    headings = re.findall(r"^## (\w+)$", text, re.MULTILINE)
    assert set(COURSE[module]) <= set(headings)


@pytest.mark.parametrize("module", COURSE)
def test_a_page_gives_no_solution_away(module: str) -> None:
    lines = {
        line.strip() for line in (PAGES / f"{module}.md").read_text(encoding="utf-8").splitlines()
    }
    assert not lines & solution_lines(PROJECT / "solutions")


DOCUMENTS = [
    *sorted((PROJECT / "docs").rglob("*.md")),
    PROJECT / "README.md",
    PROJECT / "CONTRIBUTING.md",
    PROJECT / "scenes" / "README.md",
    PROJECT / "paper" / "paper.md",
]


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_every_file_that_is_named_is_there(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    folders = "assignments|benchmarks|course|docs|paper|scenes|solutions|tests"
    for name in re.findall(rf"`((?:{folders})/[\w/.]*)`", text):
        # Nor are a name to be replaced, the module that a reader adds, or a file that a command writes.
        made = (
            "NAME" in name
            or "vignetting" in name
            or "reflector_light" in name
            or name in ("scenes/scene.schema.json", "assignments/.course/checked.json")
        )
        if not made:
            assert (PROJECT / name).exists(), name
