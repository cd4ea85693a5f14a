"""The site in a browser without a network: the slider between two pictures, and formulas.

Every page is opened by tests/docs/test_accessibility.py.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.browser import tab_to, untroubled


def test_no_line_begins_with_the_punctuation_of_a_formula(browser: Any, site: Path) -> None:
    page = browser.new_page()
    page.goto((site / "modules" / "soft_shadows.html").as_uri())
    # What is folded has no lines.
    page.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
    joined = page.locator(".joined")
    assert joined.count() > 3
    for width in (300, 390, 500, 800):
        page.set_viewport_size({"width": width, "height": 800})
        for box in joined.all():
            lines = box.evaluate(
                "(box) => { const range = document.createRange(); range.selectNodeContents(box.lastChild);"
                " return range.getBoundingClientRect().left - box.firstChild.getBoundingClientRect().right; }"
            )
            assert -1 < lines < 3, box.inner_text()
    page.close()


@pytest.fixture
def pair(browser: Any, site: Path) -> Iterator[Any]:
    """The page of a module with a pair of pictures."""
    page = browser.new_page(viewport={"width": 1280, "height": 1000})
    page.goto((site / "modules" / "soft_shadows.html").as_uri())
    yield page
    page.close()


def _border(page: Any) -> str:
    return str(page.evaluate("getComputedStyle(document.querySelector('.after')).clipPath"))


def test_the_slider_moves_the_border_by_keyboard(pair: Any) -> None:
    before, shown = _border(pair), pair.locator(".pair").screenshot()
    tab_to(pair, ".before-after input", 80)
    assert pair.evaluate("document.activeElement.getAttribute('aria-label')")
    for _ in range(10):
        pair.keyboard.press("ArrowRight")
    assert (before, _border(pair)) == ("inset(0px 0px 0px 50%)", "inset(0px 0px 0px 60%)")
    assert pair.locator(".pair").screenshot() != shown


def test_the_pointer_moves_the_border(pair: Any) -> None:
    box = pair.locator(".pair").bounding_box()
    pair.mouse.move(box["x"] + box["width"] / 2, box["y"] + 50)
    pair.mouse.down()
    pair.mouse.move(box["x"] + box["width"] / 5, box["y"] + 60)
    pair.mouse.up()
    assert _border(pair) == "inset(0px 0px 0px 20%)"
    assert pair.locator(".before-after input").input_value() == "20"


def test_without_scripts_both_pictures_stand_side_by_side(browser: Any, site: Path) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((site / "modules" / "soft_shadows.html").as_uri())
    left, right = (page.locator(f".{side} img").bounding_box() for side in ("before", "after"))
    assert left["x"] + left["width"] <= right["x"]
    assert left["y"] == right["y"]
    assert page.locator(".before-after input").count() == 0
    context.close()


@pytest.mark.parametrize("page_name", ["soft_shadows", "supersampling"])
def test_words_that_a_search_has_found_are_marked(browser: Any, site: Path, page_name: str) -> None:
    """Sphinx's script had failed at the first title of a drawing that holds the word."""
    page = browser.new_page()
    failed: list[str] = []
    page.on("pageerror", lambda error: failed.append(str(error)))
    address = (site / "modules" / f"{page_name}.html").as_uri()
    page.goto(f"{address}?highlight=light+sample+picture")
    page.wait_for_selector("span.highlighted")
    page.wait_for_timeout(100)
    assert not failed
    page.close()


def test_a_page_that_is_taken_again_is_as_good_as_new(browser: Any, tmp_path: Path) -> None:
    (tmp_path / "page.html").write_text("<!doctype html><title>A</title><p>Words</p>")
    options = {"viewport": {"width": 613, "height": 401}}
    state = """() => [innerWidth, matchMedia("(prefers-color-scheme: dark)").matches,
      matchMedia("print").matches, localStorage.length, sessionStorage.length, window.mine ?? null]"""
    pages = []
    for _ in range(2):
        with untroubled(browser, **options) as page:
            page.goto((tmp_path / "page.html").as_uri())
            assert page.evaluate(state) == [613, False, False, 0, 0, None]
            page.evaluate("localStorage.a = sessionStorage.b = window.mine = 1")
            page.set_viewport_size({"width": 300, "height": 200})
            page.emulate_media(color_scheme="dark", media="print")
            pages.append(page)
    assert pages[0] is pages[1]
    with untroubled(browser, alone=True, **options) as page:
        assert page is not pages[0]


def test_what_goes_wrong_in_a_page_is_told_once_and_the_page_goes(browser: Any) -> None:
    options = {"viewport": {"width": 614, "height": 401}}
    with pytest.raises(AssertionError, match="wrong"), untroubled(browser, **options) as page:
        page.set_content("<script>throw new Error('wrong')</script>")
    with untroubled(browser, **options) as other:
        assert other is not page
        other.set_content("<p>Words")
