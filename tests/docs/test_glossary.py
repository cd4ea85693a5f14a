"""The glossary: its terms lead to headings that there are, and the site's search leads to where they are explained."""

import re
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

from sitebuild.glossary import FILE, SOUGHT, directives, entries, indexed, slug

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE

TEXT = FILE.read_text(encoding="utf-8")
ENTRIES = entries(TEXT)

NAMES = {f"modules/{module}" for module in COURSE} | {entry.page for entry in ENTRIES} - {""}
NAMES |= {page for page, _ in SOUGHT}

PAGES = {
    name: (PROJECT / "docs" / f"{name}.md").read_text(encoding="utf-8") for name in sorted(NAMES)
}

ASKED = {
    "penumbra": "modules/soft_shadows",
    "fireflies": "modules/path_tracing",
    "bokeh": "modules/thin_lens",
    "aliasing": "modules/supersampling",
    "next-event estimation": "modules/path_tracing",
    "cite": "cite",
    "MIS": "modules/multiple_importance",
    "Sobol": "modules/quasi_monte_carlo",
    "gamma": "modules/film",
    "defocus": "modules/thin_lens",
    "HDRI": "modules/environment_light",
    "acne": "architecture",
    "shadow acne": "architecture",
    "light leak": "architecture",
    "ground truth": "accuracy",
    "ambient occlusion": "modules/path_tracing",
    "install": "guides/start",
    "Windows": "guides/start",
    "syllabus": "guides/teaching",
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
    places = [(entry.page, entry.place) for entry in ENTRIES if entry.page]
    for page, place in [*places, *SOUGHT]:
        # Those that entries of the index can stand before.
        headings = re.findall(r"^## (.+)$", PAGES[page], re.MULTILINE)
        assert place in {"", *map(slug, headings)}, page


def test_every_module_explains_a_term() -> None:
    assert {entry.page for entry in ENTRIES} >= {f"modules/{module}" for module in COURSE}


@pytest.mark.parametrize("name", PAGES)
def test_a_page_gets_entries_of_the_index_and_nothing_else(name: str) -> None:
    page = indexed(name, PAGES[name])
    found = re.findall(r"```\{index\} (.+)\n```\n", page)
    terms = {term.removeprefix("! ") for line in found for term in line.split(", ")}
    wanted = {term for entry in ENTRIES if entry.page == name for term in entry.terms}
    assert terms == wanted.union(*(words for (where, _), words in SOUGHT.items() if where == name))
    rest = re.sub(r"```\{index\} .+\n```\n", "", page)
    assert re.sub(r"\n\n+", "\n\n", rest) == re.sub(r"\n\n+", "\n\n", PAGES[name])


def test_a_list_becomes_a_directive() -> None:
    page = "# Words\n\n- **Umbra**, **full\n  shadow**: none.\n- **Bias**: of the\n  [mean](a.md).\n\nEnd.\n"
    page = page.replace("full\n  shadow", "full shadow")
    assert directives(page) == (
        "# Words\n\n```{glossary}\nUmbra\nfull shadow\n  none.\n\nBias\n  of the [mean](a.md).\n\n```\n"
        "\nEnd.\n"
    )


def test_a_search_finds_first_the_page_that_explains(site: Path, browser: Any) -> None:
    asked = {term.lower(): page for term, page in ASKED.items()}
    places = [(entry.terms, entry.page or "glossary") for entry in ENTRIES]
    for terms, page in [*places, *((words, page) for (page, _), words in SOUGHT.items())]:
        for term in terms:
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
