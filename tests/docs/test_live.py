"""Pictures that the page computes: both sides are one where the effect is off, and errors fall with the samples."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.engine.functions.effects import PROJECT
from tests.browser import untroubled

PAGES = {
    "index": "home",
    **{
        f"modules/{name}": name
        for name in (
            "soft_shadows",
            "glossy",
            "thin_lens",
            "motion_blur",
            "cube_map",
            "microfacets",
        )
    },
}

CODES = """(figure) => [...figure.querySelectorAll(".pair canvas")].map((canvas) =>
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


def numbers(text: str) -> list[float]:
    return [float(each) for each in re.findall(r"[0-9]+(?:\.[0-9]+)?", text)]


def test_the_penumbra_is_as_wide_as_geometry_says_and_the_lamp_is_dragged(
    browser: Any, site: Path
) -> None:
    with untroubled(browser) as page:
        figure = opened(page, site, "modules/soft_shadows")
        canvas = figure.locator("canvas").nth(1)
        before = numbers(figure.locator(".geometry").inner_text())
        for moves in range(2):
            radius, across, height = (
                float(figure.get_by_label(name).input_value())
                for name in ("Radius of the lamp", "Lamp, to the side", "Lamp, above the floor")
            )
            # Of a point x of the floor, the line over the edge passes the ball's centre at this distance.
            x = np.linspace(-8, -0.01, 800_000)
            passes = np.abs((across - x) * 1 - height * -x) / np.hypot(1, x)
            seen = x[passes < radius]
            wide = numbers(figure.locator(".geometry").inner_text())[3]
            assert wide == pytest.approx(seen.max() - seen.min(), abs=0.006)
            if moves == 0:
                canvas.scroll_into_view_if_needed()
                box = canvas.bounding_box()
                page.mouse.move(box["x"] + 0.8 * box["width"], box["y"] + 0.3 * box["height"])
                page.mouse.down()
                page.mouse.move(box["x"] + 0.85 * box["width"], box["y"] + 0.25 * box["height"])
                page.mouse.up()
                page.wait_for_function(
                    "before => !document.querySelector('.geometry').textContent.includes(before)",
                    arg=f"{before[3]:.2f} apart",
                )
                assert float(figure.get_by_label("Lamp, above the floor").input_value()) > height


def test_the_lobe_of_gold_has_the_factors_of_the_course(browser: Any, site: Path) -> None:
    """The page's numbers against the definitions: GGX and Smith's lambda, as Walter wrote them."""
    with untroubled(browser) as page:
        figure = opened(page, site, "modules/microfacets")
        lobe = figure.get_by_role("slider", name="Angle of the viewer's ray")
        lobe.focus()
        for _ in range(5):
            page.keyboard.press("ArrowLeft")
        said = figure.locator(".geometry").inner_text()
        shown = {
            name: float(re.search(rf"{name} = ([0-9.]+[0-9])", said)[1])  # type: ignore[index]
            for name in ("D", "G1", "G2", "F")
        }
        from_, alpha, at = 45.0, 0.3, numbers(said)[2]
        assert numbers(said)[:2] == [from_, alpha]
        i, o = np.radians([from_, at])
        tangent = np.tan((o - i) / 2)
        d = alpha**2 / (np.pi * np.cos((o - i) / 2) ** 4 * (alpha**2 + tangent**2) ** 2)
        lambdas = [(np.sqrt(1 + (alpha * np.tan(each)) ** 2) - 1) / 2 for each in (i, o)]
        # The peak is told in whole degrees.
        assert shown["D"] == pytest.approx(d, rel=0.02)
        assert shown["G1"] == pytest.approx(1 / (1 + lambdas[0]), abs=1e-3)
        assert shown["G2"] == pytest.approx(1 / (1 + sum(lambdas)), abs=2e-3)
        assert 0.77 <= shown["F"] < 0.78


def test_without_webgl_the_page_has_its_other_pictures(browser: Any, site: Path) -> None:
    with untroubled(browser, alone=True) as page:
        page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
        page.goto((site / "modules" / "soft_shadows.html").as_uri())
        page.wait_for_timeout(200)
        assert not page.locator("figure.computed").first.is_visible()
        assert page.locator("figure.series").count() >= 1


def test_a_phone_is_wide_enough(browser: Any, site: Path) -> None:
    with untroubled(browser, alone=True, viewport={"width": 390, "height": 800}) as page:
        # In their full size, which takes long without a graphics card.
        page.set_default_timeout(300_000)
        script = (PROJECT / "docs" / "_static" / "live.js").read_text(encoding="utf-8")
        page.route(
            re.compile(r"/live\.js"),
            lambda route: route.fulfill(body=script, content_type="text/javascript"),
        )
        opened(page, site, "index")
        assert page.evaluate("document.querySelector('.computed canvas').width") == 360
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
