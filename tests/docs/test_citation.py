"""How the course is cited and licensed: every file that says so says the same."""

import re
import tomllib
from typing import Any

import pytest
import yaml

from course import __version__
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE, FURTHER, MODULES
from course.school.grading.known import known

CITATION = yaml.safe_load((PROJECT / "CITATION.cff").read_text(encoding="utf-8"))
PROJECT_TABLE: dict[str, Any] = tomllib.loads(
    (PROJECT / "pyproject.toml").read_text(encoding="utf-8")
)["project"]

PAPER = (PROJECT / "paper" / "paper.md").read_text(encoding="utf-8")
BIBLIOGRAPHY = (PROJECT / "paper" / "paper.bib").read_text(encoding="utf-8")

KNOWN_KEYS = {
    *("abstract", "authors", "cff-version", "date-released", "doi", "keywords", "license"),
    *("message", "references", "repository-code", "title", "type", "url", "version"),
}
"""Of the format 1.2.0, those that this file may need."""

LONGEST = 1000
"""Words of a paper in the Journal of Open Source Education."""


def text_of(name: str) -> str:
    return (PROJECT / name).read_text(encoding="utf-8")


def test_the_citation_is_of_its_format_and_of_this_version() -> None:
    assert {"authors", "cff-version", "message", "title"} <= set(CITATION) <= KNOWN_KEYS
    assert CITATION["cff-version"] == "1.2.0"
    assert CITATION["type"] == "software"
    assert all(set(author) & {"name", "family-names"} for author in CITATION["authors"])
    # Versions such as 0.10 would be numbers in YAML.
    assert CITATION["version"] == __version__ == PROJECT_TABLE["version"]


def test_authors_and_licence_are_those_of_the_package() -> None:
    names = [author["name"] for author in CITATION["authors"]]
    assert names == [author["name"] for author in PROJECT_TABLE["authors"]]
    assert PROJECT_TABLE["license"].split(" AND ") == [CITATION["license"], "CC-BY-4.0"]
    for file in PROJECT_TABLE["license-files"]:
        assert names[0] in text_of(file)
    assert "creativecommons.org/licenses/by/4.0" in text_of("docs/LICENSE")


def test_bibtex_says_what_the_citation_says() -> None:
    (entry,) = re.findall(r"@software\{.*?^\}", text_of("docs/cite.md"), re.DOTALL | re.MULTILINE)
    fields = dict(re.findall(r"^ +(\w+) += \{+(.*?)\}+,?$", entry, re.MULTILINE))
    assert fields == {
        "author": CITATION["authors"][0]["name"],
        **{key: CITATION[key] for key in ("title", "version", "license")},
    }


def test_the_paper_has_its_head_and_no_more_words_than_it_may() -> None:
    _, head, body = PAPER.split("---\n", 2)
    found = yaml.safe_load(head)
    assert {"title", "tags", "authors", "affiliations", "date", "bibliography"} == set(found)
    assert (PROJECT / "paper" / found["bibliography"]).is_file()
    indices = {affiliation["index"] for affiliation in found["affiliations"]}
    assert {author["affiliation"] for author in found["authors"]} <= indices
    assert len(body.split()) <= LONGEST
    assert "# Statement of need\n" in body


def test_what_the_paper_cites_is_in_its_bibliography_and_nothing_else_is() -> None:
    cited = set(re.findall(r"@(\w+)", PAPER))
    assert cited == set(re.findall(r"^@\w+\{(\w+),$", BIBLIOGRAPHY, re.MULTILINE))


@pytest.mark.parametrize("name", ["paper/paper.md", "docs/guides/teaching.md"])
def test_there_are_as_many_functions_and_modules_as_is_said(name: str) -> None:
    """Without a number that every new module would change."""
    text = " ".join(text_of(name).split())
    assert "more than a hundred functions" in text
    assert sum(map(len, COURSE.values())) > 100
    for core in re.findall(r"(\w+) core modules and three times as many further", text):
        assert (core, len(MODULES)) == ("Six", 6)
        assert len(FURTHER) >= 3 * len(MODULES)


def test_the_wrong_submissions_of_each_module_are_as_many_as_the_paper_says() -> None:
    assert "at least thirty for each module" in " ".join(PAPER.split())
    for module in COURSE:
        assert sum(not one.right for one in known(module)) >= 30


def test_the_checklist_has_its_thirteen_items_and_leads_to_what_it_says() -> None:
    text = text_of("paper/checklist.md")
    assert re.findall(r"^\| (\d+) \|", text, re.MULTILINE) == [str(k) for k in range(1, 14)]
    for link in re.findall(r"\]\(([^)]+)\)", text):
        name, _, heading = link.partition("#")
        page = (PROJECT / "paper" / name).read_text(encoding="utf-8")
        headings = re.findall(r"^#+ (.*)$", page, re.MULTILINE)
        slugs = [re.sub(r"[^\w -]", "", each).lower().replace(" ", "-") for each in headings]
        assert not heading or heading in slugs, link
    for name in re.findall(r"`((?:docs|tests)/[\w/.]+)`", text):
        assert (PROJECT / name).is_file(), name
