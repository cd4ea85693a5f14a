"""The explorer of sample patterns: its points are the course's, its numbers are right, its controls change it."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.base.errors import CourseError
from course.engine.core.types import Floats32
from course.engine.functions.effects import PROJECT, Effects
from course.engine.terms.samplers.sobol import owen_scrambled, sobol_words
from tests.browser import untroubled

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

from sitebuild import pattern_explorer
from sitebuild.place import Place

MODULES = Effects(PROJECT / "solutions")
STATIC = PROJECT / "docs" / "_static"

COUNTS = (1, 2, 3, 16, 30, 64, 1000, 1024)


@pytest.fixture(scope="module")
def patterns(browser: Any) -> Iterator[Any]:
    """An empty page that has the point sets; call its evaluate with P for them."""
    page = browser.new_page()
    page.add_script_tag(path=STATIC / "patterns.js")
    page.evaluate("() => { window.listed = ({ x, y }) => [[...x], [...y]]; }")
    yield page
    page.close()


def _points(patterns: Any, expression: str, given: Any = None) -> Floats32:
    """The points of an expression over P = penumbra.patterns and a value from here, (2, n)."""
    listed = patterns.evaluate(
        f"given => {{ const P = penumbra.patterns; return listed({expression}) }}", given
    )
    return np.array(listed, np.float32)


class _Numbers:
    """A generator that gives known numbers, in the place of NumPy's."""

    def __init__(self, numbers: Floats32) -> None:
        self.numbers = numbers

    def random(self, shape: tuple[int, ...], dtype: type[np.float32]) -> Floats32:
        return self.numbers[: np.prod(shape)].reshape(shape).astype(dtype)


@pytest.mark.parametrize("count", COUNTS)
def test_sobol_points_are_the_courses(patterns: Any, count: int) -> None:
    np.testing.assert_array_equal(
        _points(patterns, f"P.sobol({count})"), pattern_explorer.sobol(count)
    )


@pytest.mark.parametrize("seeds", [[0, 0], [1, 2**32 - 1], [0x9E3779B9, 12345]])
def test_scrambled_sobol_points_are_the_courses(patterns: Any, seeds: list[int]) -> None:
    words = sobol_words(np.arange(1024, dtype=np.uint32))
    expected = owen_scrambled(words, np.array(seeds, np.uint32)[:, None]) >> np.uint32(8)
    np.testing.assert_array_equal(
        _points(patterns, "P.scrambledSobol(1024, given)", seeds),
        expected.astype(np.float32) * np.float32(2**-24),
    )


@pytest.mark.parametrize("k", [1, 3, 8, 31])
def test_regular_points_are_the_courses(patterns: Any, k: int) -> None:
    expected = MODULES.function("supersampling", "regular")(k, 1)[:, 0]
    for count in (k * k, k * k + 2 * k):
        np.testing.assert_array_equal(_points(patterns, f"P.regular({count})"), expected)


@pytest.mark.parametrize("name", ["random", "jittered"])
@pytest.mark.parametrize("k", [1, 3, 8, 31])
def test_points_of_the_same_numbers_are_the_courses(patterns: Any, name: str, k: int) -> None:
    numbers = np.random.default_rng(k).random(2 * k * k, np.float32)
    expected = MODULES.function("supersampling", name)(k, 1, _Numbers(numbers))[:, 0]
    drawn = _points(
        patterns,
        f"(() => {{ let i = 0; return P.{name}({k * k}, () => given[i++]) }})()",
        numbers.tolist(),
    )
    np.testing.assert_array_equal(drawn, expected)


@pytest.mark.parametrize("count", COUNTS)
def test_halton_and_hammersley_points_are_the_courses(patterns: Any, count: int) -> None:
    halton = MODULES.function("quasi_monte_carlo", "halton")(np.arange(count), 2)
    np.testing.assert_array_equal(_points(patterns, f"P.halton({count})"), halton)
    hammersley = MODULES.function("quasi_monte_carlo", "hammersley")(count, 2)
    np.testing.assert_array_equal(_points(patterns, f"P.hammersley({count})"), hammersley)


@pytest.mark.parametrize("domain", ["disk", "sphere"])
def test_warps_are_the_courses(patterns: Any, domain: str) -> None:
    u = np.random.default_rng(5).random((2, 200))
    warped = patterns.evaluate(
        f"([u, v]) => u.map((each, i) => penumbra.patterns.{domain}(each, v[i], false))", u.tolist()
    )
    expected = MODULES.function("sampling", f"{domain}_by_polar")(u)
    np.testing.assert_allclose(np.transpose(warped), expected, atol=1e-12)


def test_the_mistaken_warps_are_the_mistakes(patterns: Any) -> None:
    """At half of the numbers: half the radius, and the equator as for the right warp; at a quarter: 45 degrees."""
    radius = patterns.evaluate("penumbra.patterns.disk(0.5, 0, true)")
    assert radius == pytest.approx([0.5, 0])
    height = patterns.evaluate("penumbra.patterns.sphere(0.25, 0, true)")
    assert height == pytest.approx([2**-0.5, 0, 2**-0.5])


def test_the_generator_is_uniform(patterns: Any) -> None:
    """The mean of 100,000 lies within 5 standard errors; a right generator fails for one seed in 1.7 million."""
    mean, low, high = patterns.evaluate(
        """() => {
            const uniform = penumbra.patterns.generator(7);
            let [sum, low, high] = [0, 1, 0];
            for (let i = 0; i < 1e5; i++) {
                const u = uniform();
                sum += u;
                low = Math.min(low, u);
                high = Math.max(high, u);
            }
            return [sum / 1e5, low, high];
        }"""
    )
    assert abs(mean - 0.5) < 5 * (1 / 12 / 1e5) ** 0.5
    assert 0 <= low < 0.001 < 0.999 < high < 1


def _star_discrepancy(points: Floats32) -> float:
    """By its definition, over all corners that can be the worst."""
    x, y = points.astype(float)
    worst = 0.0
    for right in [*x, 1.0]:
        for top in [*y, 1.0]:
            inside = np.mean((x < right) & (y < top))
            upto = np.mean((x <= right) & (y <= top))
            worst = max(worst, right * top - inside, upto - right * top)
    return worst


@pytest.mark.parametrize(
    "made", ["regular(25)", "sobol(16)", "random(20, P.generator(3))", "halton(1)"]
)
def test_the_star_discrepancy_is_right(patterns: Any, made: str) -> None:
    measured = patterns.evaluate(
        f"() => {{ const P = penumbra.patterns; return P.starDiscrepancy(P.{made}) }}"
    )
    points = _points(patterns, f"P.{made}")
    assert measured == pytest.approx(_star_discrepancy(points), abs=1e-12)


@pytest.mark.parametrize(
    ("x", "y", "worst"),
    [
        (0.5, 0.5, 0.75),  # the closed box up to the point: 1/4 of the area, all of the points
        (
            0.5,
            0.9,
            0.9,
        ),  # the open box below it, as wide as the square: 0.9 of the area, none of them
        (0.9, 0.5, 0.9),  # the open box to its left
    ],
)
def test_the_star_discrepancy_of_one_point(patterns: Any, x: float, y: float, worst: float) -> None:
    measured = patterns.evaluate(f"penumbra.patterns.starDiscrepancy({{ x: [{x}], y: [{y}] }})")
    assert measured == pytest.approx(worst, abs=1e-12)


def test_cells_are_counted(patterns: Any) -> None:
    count = "(made, c, r) => penumbra.patterns.cellsHit(made, c, r)"
    for columns, rows in ((8, 8), (64, 1), (1, 64), (32, 2), (4, 16)):
        call = f"({count})(penumbra.patterns.sobol(64), {columns}, {rows})"
        assert patterns.evaluate(call) == 64
    assert patterns.evaluate(f"({count})(penumbra.patterns.regular(64), 64, 1)") == 8


def _place(tmp_path: Path) -> Place:
    return Place(up="", blank=True, made=tmp_path, files={})


def test_what_is_asked_for_has_to_be_there(tmp_path: Path) -> None:
    with pytest.raises(CourseError, match="no domain 'cube'; there are square, disk, sphere"):
        pattern_explorer.pattern_explorer(_place(tmp_path), "cube")
    for word in ("diagonal", "0", "1025"):
        with pytest.raises(CourseError, match=word):
            pattern_explorer.pattern_explorer(_place(tmp_path), "square", word)


@pytest.mark.parametrize(("domain", "points"), [("square", 4 * 64), ("disk", 2 * 400)])
def test_the_still_drawing_has_its_points(tmp_path: Path, domain: str, points: int) -> None:
    made = pattern_explorer.pattern_explorer(_place(tmp_path), domain, "sobol 16 wide")
    assert made.count("<circle") == points
    assert 'data-pattern="sobol" data-count="16" data-cells="wide"' in made
    assert "\n\n" not in made


def test_the_still_drawings_measures_are_right(tmp_path: Path) -> None:
    """Four standard errors around what the closed form gives; a right drawing fails for one seed in 16,000."""
    made = pattern_explorer.pattern_explorer(_place(tmp_path), "disk")
    right, wrong = map(float, re.findall(r"the mean of x² is ([0-9.]+)", made))
    assert abs(right - 1 / 4) < 4 * (1 / 16 / 400) ** 0.5
    # r uniform: E x^2 = 1/6 and E x^4 = 3/40.
    assert abs(wrong - 1 / 6) < 4 * ((3 / 40 - 1 / 36) / 400) ** 0.5
    made = pattern_explorer.pattern_explorer(_place(tmp_path), "square")
    assert made.count("of 64 cells, 8 by 8, 64 hold a point") == 3


@pytest.fixture
def explorer(browser: Any, site: Path) -> Iterator[Any]:
    """The explorer's own page; nothing may go wrong on it."""
    view = {"viewport": {"width": 1280, "height": 1000}, "color_scheme": "light"}
    with untroubled(browser, **view) as page:
        page.goto((site / "explorer.html").as_uri())
        yield page


def _drawn(page: Any) -> bytes:
    return bytes(page.locator(".stage canvas").first.screenshot())


def _said(page: Any) -> str:
    return str(page.locator(".said").inner_text())


def _choose(page: Any, name: str, value: str) -> None:
    page.get_by_role("combobox", name=name, exact=True).select_option(value)


def test_the_number_changes_by_keyboard(explorer: Any) -> None:
    slider = explorer.get_by_role("slider", name="samples")
    before = _drawn(explorer)
    assert _said(explorer).startswith(
        "64 points in the square: jittered. The star discrepancy is 0."
    )
    assert "Of 64 cells, 8 by 8, 64 hold a point." in _said(explorer)
    slider.focus()
    explorer.keyboard.press("End")
    assert _said(explorer).startswith("1024 points")
    assert slider.get_attribute("aria-valuetext") == "1024"
    assert _drawn(explorer) != before
    explorer.keyboard.press("Home")
    assert _said(explorer).startswith("1 point in the square")


def test_a_grid_says_that_it_takes_square_numbers(explorer: Any) -> None:
    _choose(explorer, "pattern", "regular")
    explorer.get_by_role("slider", name="samples").fill("29")
    assert _said(explorer).startswith(
        "25 points in the square: regular. A grid takes a square number; the largest up to 30 is 25."
    )


def test_only_chance_can_be_drawn_again(explorer: Any) -> None:
    again = explorer.get_by_role("button", name="Draw again")
    before = _drawn(explorer)
    again.click()
    assert _drawn(explorer) != before
    _choose(explorer, "pattern", "sobol")
    assert again.is_disabled()


def test_every_choice_says_what_is_drawn(explorer: Any) -> None:
    said = explorer.evaluate(
        """() => {
            const said = [];
            const [pattern, domain, cells] = document.querySelectorAll(".choices select");
            const choose = (select, option) => {
                select.value = option.value;
                select.dispatchEvent(new Event("change"));
            };
            for (const a of pattern.options) for (const b of domain.options) for (const c of cells.options) {
                [pattern, domain, cells].forEach((select, i) => choose(select, [a, b, c][i]));
                said.push([a.value, b.value, c.value, document.querySelector(".said").textContent]);
            }
            return said;
        }"""
    )
    assert {pattern for pattern, *_ in said} == set(pattern_explorer.PATTERNS)
    assert {cells for *_, cells, _ in said} == set(pattern_explorer.CELLS)
    assert len(said) == 7 * 3 * 6
    for pattern, domain, cells, text in said:
        assert pattern in text.lower()
        assert f" the {domain}: " in text
        assert ("cells" in text) == (cells != "none")


def test_a_mistake_shows_in_the_mean(explorer: Any) -> None:
    _choose(explorer, "domain", "disk")
    _choose(explorer, "pattern", "hammersley")
    assert "The mean of x² is 0.25" in _said(explorer) or "The mean of x² is 0.24" in _said(
        explorer
    )
    before = _drawn(explorer)
    explorer.get_by_label("uniform radius (a common mistake)").check()
    assert "uniform radius (a common mistake)" in _said(explorer)
    assert "The mean of x² is 0.1" in _said(explorer)
    assert _drawn(explorer) != before


def test_the_sphere_turns_by_keyboard_and_by_pointer(explorer: Any) -> None:
    _choose(explorer, "domain", "sphere")
    turn = explorer.get_by_role("slider", name="turn")
    before = _drawn(explorer)
    turn.focus()
    explorer.keyboard.press("ArrowRight")
    assert turn.input_value() == "35"
    turned = _drawn(explorer)
    assert turned != before
    box = explorer.locator(".stage canvas").first.bounding_box()
    explorer.mouse.move(box["x"] + 200, box["y"] + 200)
    explorer.mouse.down()
    explorer.mouse.move(box["x"] + 240, box["y"] + 220)
    explorer.mouse.up()
    assert _drawn(explorer) != turned
    # 115 degrees across: 12 to the left and 6 downwards, to the sliders' steps of 5.
    assert turn.input_value() == "25"
    assert explorer.get_by_role("slider", name="tilt").input_value() == "30"


def test_the_drawing_follows_the_scheme(explorer: Any) -> None:
    """Its points have at least 4.5 times the background's luminance, or a part of it, in either scheme."""
    ratio = """() => {
        const parse = (text) => text.match(/[0-9.]+/g).slice(0, 3).map((v) => {
            v /= 255;
            return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
        });
        const luminance = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
        const canvas = document.querySelector(".stage canvas");
        const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
        const ink = getComputedStyle(canvas).color;
        const [r, g, b] = ink.match(/[0-9]+/g).map(Number);
        let drawn = 0;
        for (let i = 0; i < data.length; i += 4) {
            if (data[i] === r && data[i + 1] === g && data[i + 2] === b && data[i + 3] === 255) drawn++;
        }
        const paper = getComputedStyle(document.body).backgroundColor;
        const [high, low] = [luminance(parse(ink)), luminance(parse(paper))].sort((a, b) => b - a);
        return [(high + 0.05) / (low + 0.05), drawn];
    }"""
    for scheme in ("light", "dark"):
        explorer.emulate_media(color_scheme=scheme)
        explorer.wait_for_function(
            f"() => {{ const [contrast, drawn] = ({ratio})(); return contrast > 4.5 && drawn > 500; }}"
        )


def test_pixels_are_the_screens(browser: Any, site: Path) -> None:
    page = browser.new_page(device_scale_factor=2, viewport={"width": 390, "height": 800})
    page.goto((site / "explorer.html").as_uri())
    canvas = page.locator(".stage canvas").first
    assert canvas.evaluate("each => each.width") == 2 * canvas.evaluate("each => each.clientWidth")
    page.close()


def test_without_scripts_there_is_a_drawing(browser: Any, site: Path) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((site / "modules" / "sampling.html").as_uri())
    for still in page.locator("svg.still").all():
        assert still.is_visible()
        assert still.get_attribute("aria-label") == (
            "Points: uniform, a common mistake: uniform radius"
            if "radius" in str(still.get_attribute("aria-label"))
            else "Points: uniform, a common mistake: uniform angle"
        )
    assert page.locator("svg.still").count() == 2
    assert "it should be 0.250" in page.locator("figure.pattern-explorer").first.inner_text()
    assert page.locator("figure.pattern-explorer canvas").count() == 0
    context.close()
