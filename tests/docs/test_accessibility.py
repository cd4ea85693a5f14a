"""Pages can be used without a mouse and by those who hear them: axe's rules of WCAG 2, and the keyboard alone."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

axe = pytest.importorskip(
    "axe_playwright_python.sync_playwright",
    reason='pages are looked at by: pip install -e ".[browser]"',
)


RULES = {"runOnly": {"type": "tag", "values": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"]}}
COLOURS = {"runOnly": {"type": "rule", "values": ["color-contrast", "link-in-text-block"]}}
"""Of these rules, those whose answer depends on the scheme."""

PARTS = 4
"""Pages are judged in so many tests, so that they can run beside each other."""


OPEN = """() => {
  for (const each of document.querySelectorAll("details")) each.open = true;
  for (const slider of document.querySelectorAll("input[type=range]")) {
    slider.value = Number(slider.value) < Number(slider.max) ? Number(slider.value) + 1 : slider.min;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }
  return document.querySelectorAll("details:not([open])").length;
}"""
"""Unfold what is folded away, and move each slider by a step."""


def _faults(page: Any, rules: dict[str, Any]) -> list[str]:
    found = axe.Axe().run(page, options=rules | {"resultTypes": ["violations"]})
    assert found.response["testEngine"]["name"] == "axe-core"
    return [
        f"{fault['id']}: {fault['help']}: {node['html'][:160]}"
        for fault in found.response["violations"]
        for node in fault["nodes"]
    ]


@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.parametrize(
    ("scheme", "width", "rules"), [("light", 390, RULES), ("dark", 1280, COLOURS)]
)
def test_axe_finds_nothing(
    browser: Any, site: Path, scheme: str, width: int, rules: dict[str, Any], part: int
) -> None:
    context = browser.new_context(
        viewport={"width": width, "height": 900}, color_scheme=scheme, offline=True
    )
    page = context.new_page()
    files = sorted(site.rglob("*.html"))[part::PARTS]
    assert files
    for file in files:
        page.goto(file.as_uri())
        assert page.evaluate(OPEN) == 0
        faults = _faults(page, rules)
        assert faults == [], f"{file.name}, {scheme}"
    context.close()


PALE = "<!doctype html><html lang=en><title>A</title><main><h1>Words</h1><p style='color:#aaa'>Pale words</p></main>"


@pytest.mark.parametrize(
    ("text", "rules", "fault"),
    [
        (PALE, COLOURS, "color-contrast"),
        (PALE, RULES, "color-contrast"),
        (PALE.replace("</main>", "<img src='data:,'></main>"), RULES, "image-alt"),
        (PALE.replace("</main>", "<input></main>"), RULES, "label"),
        (PALE.replace(" lang=en", ""), RULES, "html-has-lang"),
    ],
)
def test_axe_finds_what_is_wrong(
    browser: Any, text: str, rules: dict[str, Any], fault: str
) -> None:
    page = browser.new_page()
    page.set_content(text)
    assert any(found.startswith(f"{fault}:") for found in _faults(page, rules))
    page.close()


def test_axe_sees_what_was_folded_away(browser: Any) -> None:
    page = browser.new_page()
    page.set_content(
        PALE.replace("<p", "<details><summary>More</summary><p").replace("</p>", "</p></details>")
    )
    assert _faults(page, COLOURS) == []
    page.evaluate(OPEN)
    assert [fault.split(":")[0] for fault in _faults(page, COLOURS)] == ["color-contrast"]
    page.close()


@pytest.fixture
def narrow(browser: Any, site: Path) -> Iterator[Any]:
    """A page on a telephone."""
    page = browser.new_page(viewport={"width": 390, "height": 800})
    page.goto((site / "modules" / "soft_shadows.html").as_uri())
    yield page
    page.close()


def _tab_to(page: Any, selector: str, presses: int = 60) -> None:
    for _ in range(presses):
        page.keyboard.press("Tab")
        if page.evaluate(f"document.activeElement.matches({selector!r})"):
            return
    raise AssertionError(f"the Tab key does not reach {selector}")


def test_among_the_first_stops_is_one_that_skips_to_the_text(narrow: Any) -> None:
    _tab_to(narrow, ".skip-to-content", 3)
    narrow.wait_for_function("document.activeElement.getBoundingClientRect().top >= -2")
    narrow.keyboard.press("Enter")
    assert narrow.evaluate("location.hash") == "#furo-main-content"
    # The next stop stands in the text.
    narrow.keyboard.press("Tab")
    assert narrow.evaluate("document.activeElement.closest('#furo-main-content, article') !== null")


def test_the_menu_opens_by_keyboard(narrow: Any) -> None:
    menu = narrow.locator(".sidebar-drawer")
    assert menu.bounding_box()["x"] < -100
    _tab_to(narrow, "#__navigation")
    focused = narrow.evaluate(
        "getComputedStyle(document.querySelector('.nav-overlay-icon')).outlineStyle"
    )
    assert focused == "solid"
    narrow.keyboard.press("Space")
    narrow.wait_for_function(
        "document.querySelector('.sidebar-drawer').getBoundingClientRect().x >= 0"
    )
    _tab_to(narrow, ".sidebar-tree a")
    narrow.keyboard.press("Enter")
    narrow.wait_for_url(lambda url: not url.endswith("soft_shadows.html"))


def test_a_closed_menu_is_passed_over(narrow: Any) -> None:
    for _ in range(8):
        narrow.keyboard.press("Tab")
        assert not narrow.evaluate("document.activeElement.closest('.sidebar-drawer') !== null")


def test_the_search_is_found_and_answers(narrow: Any) -> None:
    _tab_to(narrow, "#__navigation")
    narrow.keyboard.press("Space")
    _tab_to(narrow, ".sidebar-search")
    narrow.keyboard.type("penumbra")
    narrow.keyboard.press("Enter")
    narrow.wait_for_url("**/search.html?q=penumbra**")
    narrow.wait_for_selector("#search-results li a")
    _tab_to(narrow, "#search-results li a")
