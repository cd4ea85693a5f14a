"""The glossary: its terms lead to headings that there are, and the site's search leads to where they are explained."""

import re
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

from sitebuild.glossary import FILE, directives, entries, indexed, slug

from course.effects import PROJECT
from course.modules import COURSE

TEXT = FILE.read_text(encoding="utf-8")
ENTRIES = entries(TEXT)

PAGES = {
    module: (PROJECT / "docs" / "modules" / f"{module}.md").read_text(encoding="utf-8")
    for module in COURSE
}

ASKED = {
    "penumbra": "modules/soft_shadows",
    "fireflies": "modules/path_tracing",
    "bokeh": "modules/thin_lens",
    "aliasing": "modules/supersampling",
    "next-event estimation": "modules/path_tracing",
    "cite": "cite",
}
"""What readers look for, and the page that they should find first."""

FIRST = """queries => queries.map(query => {
  const [page, , anchor] = Search._performSearch(...Search._parseQuery(query)).at(-1) ?? [];
  return [page, anchor];
})"""
"""Of the results as the page would show them, the first; Sphinx's own script takes them from the end."""


def test_every_line_of_its_lists_is_an_entry_and_no_term_stands_twice() -> None:
    assert len(ENTRIES) == TEXT.count("\n- ") > 70
    terms = [term.lower() for entry in ENTRIES for term in entry.terms]
    assert sorted(set(terms)) == sorted(terms)
    # A directive takes them apart at these.
    assert not [term for term in terms if set(term) & set(",;:!")]


def test_terms_lead_to_headings_that_there_are() -> None:
    for entry in ENTRIES:
        if entry.module:
            headings = re.findall(r"^##+ (.+)$", PAGES[entry.module], re.MULTILINE)
            assert entry.place in {"", *map(slug, headings)}, entry.terms


def test_every_module_explains_a_term() -> None:
    assert {entry.module for entry in ENTRIES} >= set(COURSE)


@pytest.mark.parametrize("module", COURSE)
def test_a_page_gets_entries_of_the_index_and_nothing_else(module: str) -> None:
    page = indexed(module, PAGES[module])
    found = re.findall(r"```\{index\} (.+)\n```\n", page)
    terms = {term.removeprefix("! ") for line in found for term in line.split(", ")}
    assert terms == {term for entry in ENTRIES if entry.module == module for term in entry.terms}
    rest = re.sub(r"```\{index\} .+\n```\n", "", page)
    assert re.sub(r"\n\n+", "\n\n", rest) == re.sub(r"\n\n+", "\n\n", PAGES[module])


def test_a_list_becomes_a_directive() -> None:
    page = "# Words\n\n- **Umbra**, **full\n  shadow**: none.\n- **Bias**: of the\n  [mean](a.md).\n\nEnd.\n"
    page = page.replace("full\n  shadow", "full shadow")
    assert directives(page) == (
        "# Words\n\n```{glossary}\nUmbra\nfull shadow\n  none.\n\nBias\n  of the [mean](a.md).\n\n```\n"
        "\nEnd.\n"
    )


def test_a_search_finds_first_the_page_that_explains(site: Path, browser: Any) -> None:
    asked = dict(ASKED)
    for entry in ENTRIES:
        for term in entry.terms:
            page = f"modules/{entry.module}" if entry.module else "glossary"
            assert asked.setdefault(term.lower(), page) == page
    page = browser.new_page()
    page.goto((site / "search.html").as_uri())
    page.wait_for_function("typeof Search !== 'undefined' && Search.hasIndex()")
    found = page.evaluate(FIRST, list(asked))
    page.close()
    assert {term: first for term, (first, _) in zip(asked, found, strict=True)} == asked
    built: dict[str, str] = {}
    for name, anchor in found:
        if name not in built:
            built[name] = (site / f"{name}.html").read_text(encoding="utf-8")
        assert not anchor or f'id="{anchor.removeprefix("#")}"' in built[name]
