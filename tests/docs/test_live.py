"""Pictures that the page computes: both sides are one where the effect is off, and errors fall with the samples."""

import re
from pathlib import Path
from typing import Any

import pytest

from course.engine.functions.effects import PROJECT
from tests.browser import untroubled

PAGES = {
    "index": "home",
    **{
        f"modules/{name}": name
        for name in ("soft_shadows", "glossy", "thin_lens", "motion_blur", "cube_map")
    },
}

CODES = """(figure) => [...figure.querySelectorAll("canvas")].map((canvas) =>
  [...canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data])"""


def opened(page: Any, site: Path, name: str) -> Any:
    page.goto((site / f"{name}.html").as_uri())
    figure = page.locator("figure.computed").first
    figure.evaluate("(figure) => figure.previousElementSibling.scrollIntoView()")
    page.wait_for_function("document.querySelector('figure.computed .pair p')?.textContent")
    return figure


def moved(page: Any, slider: Any, value: float) -> None:
    """Move a slider, and wait until errors have been measured anew."""
    page.evaluate(
        "for (const each of document.querySelectorAll('.computed .pair p')) each.textContent = ''"
    )
    slider.evaluate(
        "(slider, value) => { slider.value = value; slider.dispatchEvent(new Event('input')); }",
        value,
    )
    page.wait_for_function(
        "[...document.querySelectorAll('.computed .pair p')].every((each) => each.textContent)"
    )


def errors(figure: Any) -> list[float]:
    return [
        float(said.rpartition(" ")[2]) for said in figure.locator(".pair p").all_text_contents()
    ]


def test_there_is_a_view_on_each_of_these_pages(site: Path) -> None:
    for name, view in PAGES.items():
        assert f'data-view="{view}" hidden' in (site / f"{name}.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", PAGES)
def test_pictures_are_seen_and_differ_by_the_effect_alone(
    browser: Any, site: Path, name: str
) -> None:
    with untroubled(browser) as page:
        figure = opened(page, site, name)
        left, right = figure.evaluate(CODES)
        for codes in (left, right):
            assert len(set(codes)) > 100
        assert left != right
        if name != "modules/cube_map":
            for slider in figure.locator("label").all():
                if (
                    slider.locator("input").get_attribute("min") == "0"
                    and "Samples" not in slider.inner_text()
                ):
                    moved(page, slider.locator("input"), 0)
            left, right = figure.evaluate(CODES)
            assert left == right


def test_more_samples_lower_the_error_of_what_has_no_bias(browser: Any, site: Path) -> None:
    with untroubled(browser) as page:
        figure = opened(page, site, "modules/motion_blur")
        samples = figure.get_by_label("Samples a pixel")
        found = []
        for power in (0, 6):
            moved(page, samples, power)
            found.append(errors(figure))
        (biased, noisy), (still_biased, quiet) = found
        # Independent samples: an eighth of the error for 64 times as many, less the noise of 256.
        assert quiet < noisy / 4
        assert still_biased > 2 * quiet
        assert biased > noisy / 4


def test_the_keyboard_moves_the_sliders(browser: Any, site: Path) -> None:
    with untroubled(browser) as page:
        figure = opened(page, site, "modules/thin_lens")
        slider = figure.get_by_label("Distance in focus")
        before = figure.evaluate(CODES)[1]
        slider.focus()
        for _ in range(12):
            page.keyboard.press("ArrowLeft")
        page.wait_for_timeout(400)
        page.wait_for_function("document.querySelector('figure.computed .pair p').textContent")
        assert slider.get_attribute("aria-valuetext") == "4.2"
        assert figure.evaluate(CODES)[1] != before


def test_without_webgl_the_page_has_its_other_pictures(browser: Any, site: Path) -> None:
    with untroubled(browser, alone=True) as page:
        page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
        page.goto((site / "modules" / "soft_shadows.html").as_uri())
        page.wait_for_timeout(200)
        assert not page.locator("figure.computed").first.is_visible()
        assert page.locator("figure.series").count() >= 1


def test_a_phone_is_wide_enough(browser: Any, site: Path) -> None:
    with untroubled(browser, alone=True, viewport={"width": 390, "height": 800}) as page:
        # In their full size.
        script = (PROJECT / "docs" / "_static" / "live.js").read_text(encoding="utf-8")
        page.route(
            re.compile(r"/live\.js"),
            lambda route: route.fulfill(body=script, content_type="text/javascript"),
        )
        opened(page, site, "index")
        assert page.evaluate("document.querySelector('.computed canvas').width") == 360
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
