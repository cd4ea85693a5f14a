"""Slides are made from the pages: nothing of a page is lost, keys turn them, and the speaker's window follows."""

import re
from pathlib import Path
from typing import Any

import pytest

from course.engine.functions.modules import COURSE
from tests.browser import untroubled
from tests.lengths import share

DECK = ".deck .slide.now"

WORDS = """(root) => [...document.querySelectorAll(`${root} p, ${root} li, ${root} figure`)]
  .filter((each) => !each.matches(".lead")).map((each) => each.textContent.replace(/\\s+/g, " ").trim())"""
"""What stands on a page or in its slides; first sentences are there twice."""

TURNED_AND_TOO_WIDE = """(count) => {
  const found = [];
  for (let number = 1; number <= count; number++) {
    const seen = document.querySelector(".slide.now .seen");
    if (seen.scrollWidth > seen.clientWidth + 2 || seen.clientHeight <= 400) found.push(location.search);
    document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
  }
  return found;
}"""
"""Turn all slides, and say which don't fit. To press a key of the browser's would draw each of them."""


@pytest.mark.parametrize("module", share([*COURSE], 3))
def test_all_of_a_page_is_in_its_slides_or_its_notes(browser: Any, site: Path, module: str) -> None:
    file = site / "modules" / f"{module}.html"
    with untroubled(browser, viewport={"width": 1280, "height": 720}) as page:
        page.goto(file.as_uri())
        words = page.evaluate(WORDS, "article")
        titles = page.evaluate(
            "[...document.querySelectorAll('article :is(h1, h2, h3)')].map((e) => e.firstChild.textContent)"
        )
        page.goto(f"{file.as_uri()}?slides")
        page.wait_for_selector(DECK)
        # A link to a figure that stands beside it is left out.
        lost = set(words) - set(page.evaluate(WORDS, ".deck")) - {"The view by itself"}
        assert lost == set()
        found = page.locator(".slide h2").all_text_contents()
        assert list(dict.fromkeys(found)) == list(dict.fromkeys(titles))
        assert page.evaluate(TURNED_AND_TOO_WIDE, len(found)) == []
        assert page.url.endswith(f"?slides={len(found)}")


def test_a_slide_has_what_its_paragraphs_say_in_formulas(browser: Any, site: Path) -> None:
    with untroubled(browser) as page:
        page.goto(f"{(site / 'modules' / 'soft_shadows.html').as_uri()}?slides")
        page.wait_for_selector(DECK)
        leads = [" ".join(each.split()) for each in page.locator(".lead").all_text_contents()]
    assert any(
        each.startswith("How wide is a penumbra? Draw") and "width" in each for each in leads
    )
    assert any("one column for each shading point. … So set the share" in each for each in leads)
    assert (
        "From a place on the floor, a point is either seen or hidden, so the edge is hard." in leads
    )


def test_keys_turn_slides_and_sliders_keep_theirs(browser: Any, site: Path) -> None:
    file = site / "modules" / "soft_shadows.html"
    with untroubled(browser) as page:
        page.goto(file.as_uri())
        page.get_by_role("button", name="Show as slides").click()
        page.wait_for_selector(DECK)
        assert not page.locator(f"{DECK} aside").is_visible()
        for key in ("n", "ArrowRight", "End", "ArrowLeft", "Home", "PageDown", "PageUp"):
            page.keyboard.press(key)
        # The browser tells of an address a little later.
        page.wait_for_url(re.compile(r"\?slides=1$"))
        assert page.locator(f"{DECK} aside").is_visible()
        slider = page.locator(f"{DECK} input[type=range]").first
        slider.focus()
        before = slider.input_value()
        page.keyboard.press("ArrowRight")
        assert slider.input_value() != before
        assert page.url.endswith("?slides=1")
        # What the page folds is on slides, and no picture twice.
        assert not page.locator(".slide details.deep, .slide .mistakes.alone").count()
        assert page.locator(".slide .mistakes").count() > 4
        page.evaluate("document.activeElement.blur()")
        page.keyboard.press("Escape")
        page.wait_for_url(file.as_uri())


def test_an_address_with_another_number_opens_a_slide(browser: Any, site: Path) -> None:
    with untroubled(browser) as page:
        for asked, shown in (("nonsense", 1), ("2.5", 2), ("-3", 1), ("", 1)):
            page.goto(f"{(site / 'modules' / 'glossy.html').as_uri()}?slides={asked}")
            page.wait_for_selector(DECK)
            assert page.url.endswith(f"?slides={shown}")


def test_the_speakers_window_follows_and_leads(browser: Any, site: Path) -> None:
    with untroubled(browser, alone=True) as page:
        page.goto(f"{(site / 'modules' / 'glossy.html').as_uri()}?slides=3")
        page.wait_for_selector(DECK)
        with page.context.expect_page() as opened:
            page.keyboard.press("s")
        speaker = opened.value
        speaker.wait_for_selector(DECK)
        assert speaker.locator(f"{DECK} aside").is_visible()
        page.keyboard.press("ArrowRight")
        speaker.wait_for_url("**/glossy.html?slides=4&notes")
        speaker.keyboard.press("ArrowRight")
        page.wait_for_url("**/glossy.html?slides=5")


WIDEST = """() => Math.max(...[...document.querySelectorAll(".slide.now .last :is(img, svg)")]
  .map((each) => each.getBoundingClientRect().width)) / innerWidth"""


def test_a_figure_uses_the_room_of_its_slide(browser: Any, site: Path) -> None:
    with untroubled(browser, viewport={"width": 1280, "height": 720}) as page:
        page.goto(f"{(site / 'modules' / 'thin_lens.html').as_uri()}?slides")
        page.wait_for_selector(DECK)
        widest: dict[str, list[float]] = {}
        for _ in range(page.locator(".slide").count()):
            for kind in (".series", ".diagram:has(.of-1)", ".mistakes:not(:has(:nth-child(3)))"):
                if page.locator(f"{DECK} .last > {kind}").count():
                    widest.setdefault(kind, []).append(page.evaluate(WIDEST))
            page.keyboard.press("ArrowRight")
        assert len(widest) == 3
        # Beside the text a figure has at least half of the width.
        assert {kind: shares for kind, shares in widest.items() if min(shares) < 0.44} == {}
