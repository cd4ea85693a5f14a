"""Pictures of mistakes are enlarged beside what is right and the difference of both, by mouse and by keyboard."""

from pathlib import Path
from typing import Any

from tests.browser import tab_to, untroubled


def test_a_mistake_opens_beside_what_is_right(browser: Any, site: Path) -> None:
    with untroubled(browser) as page:
        page.goto((site / "modules" / "soft_shadows.html").as_uri() + "#light_grid")
        first = page.locator("#light-grid details.deep")
        group = first.locator(".mistakes").first
        assert not group.is_visible()
        alone = first.locator("xpath=preceding::figure[1]")
        assert "right" in alone.get_attribute("class").split()
        first.locator("summary").click()
        tab_to(page, ".mistakes button", 400)
        page.keyboard.press("Enter")
        dialog = page.locator("dialog.mistake")
        assert dialog.is_visible()
        captions = dialog.locator("figcaption").all_text_contents()
        assert [caption.partition(",")[0] for caption in captions] == [
            "Right",
            "With the mistake",
            "Difference",
        ]
        right, wrong, *both = dialog.locator("img").evaluate_all(
            "(all) => all.map((each) => each.src)"
        )
        assert both == [right, wrong]
        assert right == group.locator("figure.right img").evaluate("(each) => each.src")
        page.keyboard.press("ArrowRight")
        assert dialog.locator("img").nth(1).evaluate("(each) => each.src") != wrong
        page.keyboard.press("ArrowLeft")
        page.keyboard.press("Escape")
        assert not dialog.is_visible()
        # Whoever closes it is where it was opened.
        assert page.evaluate("document.activeElement.matches('.mistakes button')")


def test_a_link_opens_what_is_folded_below_its_heading_and_around_its_place(
    browser: Any, site: Path
) -> None:
    with untroubled(browser) as page:
        page.goto((site / "modules" / "soft_shadows.html").as_uri() + "#the-integral")
        formula, sources = (
            page.locator(f"#{name} > details") for name in ("the-integral", "sources")
        )
        assert formula.locator("math").first.is_visible()
        assert sources.get_attribute("open") is None
        page.evaluate("document.querySelector('#sources li').id = 'deep'; location.hash = '#deep'")
        sources.locator("#deep").wait_for(timeout=2000)


def test_plots_are_marked_so_that_the_dark_scheme_can_turn_them(site: Path) -> None:
    text = (site / "modules" / "soft_shadows.html").read_text(encoding="utf-8")
    assert '<figure class="right plot">' in text
    assert '<figure class="wrong">' in text
