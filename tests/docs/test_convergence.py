"""Plots of what the benchmarks measured: numbers in their places, readable in both schemes, by pointer and by keys."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from html import unescape
from math import log
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from course.base.errors import CourseError
from course.benchmarking import labels
from course.benchmarking.estimators import BENCHED, FURTHER_BENCHED
from course.benchmarking.plot_data import Plot, Record, Series, write_records
from course.benchmarking.tables import digits
from course.cli.bench import EXACT
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from tests.browser import untroubled

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')
pytest.importorskip("latex2mathml", reason='the site needs: pip install -e ".[docs]"')

from sitebuild import convergence, convergence_plot, peer_times

STYLES = PROJECT / "docs" / "_static" / "plots.css"
OWN = sorted(
    path.stem
    for path in (PROJECT / "docs" / "data").glob("*.json")
    if path.stem not in ("bench", "ratios", "peers", "peer_agreement", "scaling")
)

SAMPLES = (1, 4, 16, 64)
RANDOM = Series(
    "random",
    0,
    {"samples": SAMPLES, "seconds": (0.01, 0.04, 0.16, 0.64)},
    tuple(0.2 * n**-0.5 for n in SAMPLES),
    order=-0.5,
)
SOBOL = Series(
    "Sobol",
    2,
    {"samples": SAMPLES, "seconds": (0.02, 0.08, 0.32, 1.28)},
    tuple(0.2 / n for n in SAMPLES),
    order=-1.0,
)
AXES = {"samples": "samples for each pixel", "seconds": "seconds"}
CROWDED = Plot(
    "crowded",
    "large numbers near each other",
    {"samples": "shots"},
    "error",
    (Series("one", 0, {"samples": (11_000, 64_000)}, (0.5, 0.4)),),
)
HURRIED = [
    Plot(
        "hurried",
        f"from {first:g} to {last:g} seconds",
        {"seconds": "seconds"},
        "error",
        (Series("one", 0, {"seconds": (first, last)}, (0.5, 1e-6)),),
    )
    for first, last in ((2e-5, 1e-4), (1.1e-5, 1.9e-5), (9e-6, 1.01e-5), (3e-5, 1.02e-2))
]
"""Microseconds have long numbers."""

PLOT = Plot("samplers", "two ways", AXES, "RMSE", (RANDOM, SOBOL), floor=0.002)


# ---------------------------------------------------------------- axes


@pytest.mark.parametrize(
    ("low", "high", "most", "fours", "expected"),
    [
        (0.9, 70, 6, True, [1, 4, 16, 64]),
        (0.9, 1100, 6, True, [1, 4, 16, 64, 256, 1024]),
        (0.9, 20000, 4, True, [1, 16, 256, 4096]),
        (0.009, 1.1, 7, False, [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1]),
        (0.0009, 1.1, 7, False, [0.001, 0.01, 0.1, 1]),
        (0.9e-6, 1.1e3, 5, False, [1e-6, 1e-4, 1e-2, 1, 1e2]),
        (0.28, 0.42, 7, False, [0.3, 0.4]),
    ],
)
def test_ticks_are_round(
    low: float, high: float, most: int, fours: bool, expected: list[float]
) -> None:
    found = labels.ticks(low, high, most, fours=fours)
    assert found == pytest.approx(expected)


@given(st.floats(1e-9, 1e6), st.floats(1.5, 1e9), st.integers(3, 9), st.booleans())
def test_ticks_lie_within_and_have_room(low: float, ratio: float, most: int, fours: bool) -> None:
    found = labels.ticks(low, low * ratio, most, fours=fours)
    assert found == sorted(set(found))
    assert len(found) <= most
    assert all(low <= tick <= low * ratio for tick in found)


@pytest.mark.parametrize(
    ("value", "text"), [(0.01, "0.01"), (1.0, "1"), (0.00002, "0.00002"), (16384.0, "16,384")]
)
def test_numbers_are_plain(value: float, text: str) -> None:
    assert labels.plain(value) == text


def test_powers_of_four_are_known() -> None:
    assert labels.powers_of_four([1, 4, 1024])
    assert not labels.powers_of_four([1, 4, 8])
    assert not labels.powers_of_four([0.25, 1])


# ---------------------------------------------------------------- plots


def _marks(svg: str) -> list[list[tuple[float, float, str]]]:
    """Of each line the places and the values of its marks."""
    lines = list(ET.fromstring(svg).iter("g"))
    return [
        [
            (float(mark.attrib["data-x"]), float(mark.attrib["data-y"]), mark.attrib["data-values"])
            for mark in line.iter("path")
            if "data-values" in mark.attrib
        ]
        for line in lines
    ]


@pytest.mark.parametrize("axis", AXES)
def test_marks_lie_where_their_logarithms_say(axis: str) -> None:
    lines = _marks(convergence_plot.svg(PLOT, axis))
    assert [len(line) for line in lines] == [4, 4]
    flat = [
        (log(x), log(y), place)
        for series, line in zip((RANDOM, SOBOL), lines, strict=True)
        for x, y, place in zip(series.x[axis], series.y, line, strict=True)
    ]
    (x0, y0, (a0, b0, _)), (x1, y1, (a1, b1, _)) = flat[0], flat[-1]
    assert a1 > a0
    assert b1 > b0
    for x, y, (a, b, _) in flat:
        # Places have one decimal.
        assert a == pytest.approx(a0 + (x - x0) / (x1 - x0) * (a1 - a0), abs=0.2)
        assert b == pytest.approx(b0 + (y - y0) / (y1 - y0) * (b1 - b0), abs=0.2)


def test_a_mark_says_what_it_stands_for() -> None:
    values = [[text for *_, text in line] for line in _marks(convergence_plot.svg(PLOT, "samples"))]
    assert values[0][1] == "random: 4 samples for each pixel, 0.0400 seconds, RMSE 0.100"
    assert values[1][3] == "Sobol: 64 samples for each pixel, 1.28 seconds, RMSE 0.00313"


def _path(svg: str, kind: str) -> list[float]:
    (found,) = [path for path in ET.fromstring(svg).iter("path") if path.get("class") == kind]
    return [float(number) for number in re.findall(r"[\d.]+", found.attrib["d"])]


def test_the_line_to_compare_with_has_order_one_half_and_lies_above() -> None:
    svg = convergence_plot.svg(PLOT, "samples")
    x0, y0, x1, y1 = _path(svg, "slope")
    random = _marks(svg)[0]
    # Random samples have this order, so the lines are parallel, a factor of 1.2 apart.
    slope = (random[-1][1] - random[0][1]) / (random[-1][0] - random[0][0])
    assert (y1 - y0) / (x1 - x0) == pytest.approx(slope, rel=0.01)
    decade = (random[-1][1] - random[0][1]) / log(8)
    assert random[-1][1] - y1 == pytest.approx(decade * log(1.2), abs=0.3)
    assert "slope" not in convergence_plot.svg(replace(PLOT, slope=False), "samples")


def test_what_the_reference_hides_is_shaded() -> None:
    svg = convergence_plot.svg(PLOT, "samples")
    (band,) = ET.fromstring(svg).iter("rect")
    first, last = _marks(svg)[1][0], _marks(svg)[1][-1]
    share = log(0.2 / 0.002) / log(0.2 / SOBOL.y[-1])
    assert float(band.attrib["y"]) == pytest.approx(
        first[1] + share * (last[1] - first[1]), abs=0.3
    )
    assert "error of the reference" in svg
    # One that is far below all errors has no place.
    assert "<rect" not in convergence_plot.svg(replace(PLOT, floor=1e-5), "samples")


def _all_plots() -> list[tuple[str, Plot]]:
    names = [*BENCHED, *FURTHER_BENCHED, *OWN]
    return [
        (name, plot)
        for name in dict.fromkeys(names)
        for record in convergence.records(name)
        for plot in record.plots
    ]


@pytest.mark.parametrize(
    ("name", "plot"),
    [*_all_plots(), *(("made up", plot) for plot in (PLOT, CROWDED, *HURRIED))],
    ids=lambda value: value if isinstance(value, str) else value.name,
)
def test_words_stay_within_and_apart(name: str, plot: Plot) -> None:
    for axis in plot.axes:
        svg = ET.fromstring(convergence_plot.svg(plot, axis))
        boxes = []
        for text in svg.iter("text"):
            width = len(text.text or "") * 6.1
            x, anchor = float(text.attrib["x"]), text.attrib["text-anchor"]
            left = x - width * {"start": 0, "middle": 0.5, "end": 1}[anchor]
            boxes.append((left, float(text.attrib["y"]), left + width, text.text))
        for left, bottom, right, words in boxes:
            assert -2 <= left <= right <= convergence_plot.WIDTH + 4, (name, words)
            assert 8 <= bottom <= convergence_plot.HEIGHT, (name, words)
        for number, (left, bottom, right, words) in enumerate(boxes):
            for other_left, other_bottom, other_right, other in boxes[:number]:
                apart = right < other_left or other_right < left or abs(bottom - other_bottom) > 9
                assert apart, (name, words, other)
        for mark in svg.iter("path"):
            if "data-x" in mark.attrib:
                assert 0 < float(mark.attrib["data-x"]) < convergence_plot.WIDTH
                assert 0 < float(mark.attrib["data-y"]) < convergence_plot.HEIGHT


def test_every_estimator_of_a_plot_has_a_style_of_its_own() -> None:
    for name, plot in _all_plots():
        styles = [
            series.style % convergence_plot.STYLES for series in plot.series if not series.predicted
        ]
        assert len(set(styles)) == len(styles), (name, plot.name)


# ---------------------------------------------------------------- the part


@pytest.fixture
def data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    one = replace(PLOT, name="rays", axes={"shots": "shots"}, series=())
    lights = replace(PLOT, name="lights", title="lamps <of> two kinds")
    record = Record("course bench glossy", "2 seeds", {"processor": "fast"}, (PLOT, lights))
    write_records(tmp_path / "bench.json", {"glossy": record})
    write_records(tmp_path / "glossy.json", {"glossy": replace(record, plots=(one,))})
    monkeypatch.setattr(convergence, "DATA", tmp_path)
    return tmp_path


PLACE: Any = SimpleNamespace()


@pytest.mark.usefixtures("data")
@pytest.mark.parametrize(
    ("words", "figures", "plots"),
    [("lights", 1, 2), ("lights samples", 1, 1), ("lights seconds", 1, 1), ("seconds", 2, 2)],
)
def test_words_choose_comparisons_and_axes(words: str, figures: int, plots: int) -> None:
    html = convergence.convergence(PLACE, "glossy", words)
    assert html.count("<figure") == figures
    assert html.count('<div class="plot">') == plots
    assert "lamps <of>" not in html
    # An empty line would end the HTML in the middle.
    for figure in html.strip().split("\n\n"):
        assert figure.startswith("<figure")
        assert figure.endswith("</figure>")


@pytest.mark.usefixtures("data")
@pytest.mark.parametrize(
    ("name", "words", "told"),
    [("glossy", "lobes", "no such plot"), ("thin_lens", "", "no measurement of thin_lens")],
)
def test_what_was_not_measured_is_told(name: str, words: str, told: str) -> None:
    with pytest.raises(CourseError, match=told):
        convergence.convergence(PLACE, name, words)


@pytest.mark.parametrize(
    "name", ["sampling", "importance_sampling", "quasi_monte_carlo", "adaptive_sampling"]
)
def test_modules_that_count_samples_measure_seconds_too(name: str) -> None:
    plots = [plot for record in convergence.records(name) for plot in record.plots]
    assert plots
    for plot in plots:
        assert "seconds" in plot.axes
        assert all(second > 0 for series in plot.series for second in series.x["seconds"])


@pytest.mark.usefixtures("data")
def test_the_table_has_the_same_numbers() -> None:
    html = convergence.convergence(PLACE, "glossy", "samplers")
    rows = re.findall(r"<tr><th scope=\"row\">(.*?)</th>(.*?)</tr>", html)
    cells = [(name, *re.findall(r"<td>(.*?)</td>", row)) for name, row in rows]
    assert cells == [
        (series.name, str(n), digits(seconds), digits(error))
        for series in (RANDOM, SOBOL)
        for n, seconds, error in zip(SAMPLES, series.x["seconds"], series.y, strict=True)
    ]
    assert "order -0.50" in html
    assert "reference's own error is 0.00200" in unescape(html)


@pytest.mark.parametrize("module", [*BENCHED, *FURTHER_BENCHED])
@pytest.mark.parametrize(("name", "axis"), [("accuracy", "samples"), ("performance", "seconds")])
def test_plots_and_tables_of_the_documents_are_of_one_measurement(
    module: str, name: str, axis: str
) -> None:
    text = (PROJECT / "docs" / f"{name}.md").read_text(encoding="utf-8")
    section = text[text.index(f"<!-- site: convergence {module} ") :].partition("\n### ")[0]
    rows = {
        tuple(cell.strip() for cell in line.strip("|").split("|"))
        for line in section.splitlines()
        if line.startswith("|")
    }
    cells = [cell for row in rows for cell in row]
    (record, *_) = convergence.records(module)
    for plot in record.plots:
        for series in plot.series:
            values = series.y if axis == "samples" else series.x["seconds"]
            for value in values:
                assert digits(value) in cells, (plot.name, series.name, value)


# ---------------------------------------------------------------- beside another program


def test_a_program_s_mark_lies_where_its_seconds_say() -> None:
    rows = [
        {"scene": "one", "seconds": {"uniform": 4.0, "Mitsuba": 1.0}},
        {"scene": "another", "seconds": {"uniform": 2.0, "Mitsuba": 16.0, "unknown": 5.0}},
    ]
    first, second = _marks(peer_times.svg("llvm", rows))
    assert [text for *_, text in first] == [
        "one, Mitsuba llvm: 1.00 seconds",
        "one, uniform: 4.00 seconds, 4.00 times Mitsuba's",
    ]
    # In each row from left to right, for the arrow keys.
    assert [text.partition(":")[0] for *_, text in second] == [
        "another, uniform",
        "another, Mitsuba llvm",
    ]
    fourfold = first[1][0] - first[0][0]
    assert second[1][0] - first[0][0] == pytest.approx(2 * fourfold, abs=0.3)
    assert second[0][0] - first[0][0] == pytest.approx(fourfold / 2, abs=0.3)
    assert first[0][1] == first[1][1] < second[0][1]


def test_a_form_that_was_not_measured_is_told() -> None:
    with pytest.raises(CourseError, match=r"benchmarks\.peers --write"):
        peer_times.peer_times(PLACE, "vulkan")


@pytest.mark.parametrize("form", ["llvm", "scalar"])
def test_the_plot_of_peers_has_the_numbers_of_its_tables(form: str) -> None:
    text = (PROJECT / "docs" / "peers.md").read_text(encoding="utf-8")
    # The first plot stands at the page's beginning, with no table below it.
    section = text[text.rindex(f"<!-- site: peer_times {form} -->") :].partition("\n### ")[0]
    html = unescape(peer_times.peer_times(PLACE, form))
    lines = [line for line in section.splitlines() if re.match(r"\| \w+( ≈)? \| \d", line)]
    assert lines
    assert html.count(f", Mitsuba {form}: ") == len(lines)
    for line in lines:
        scene = " ".join(cell.strip() for cell in line.split("|")[1:3])
        shown = [float(seconds) for seconds in re.findall(r" (\d+\.\d{3}) ", line)]
        drawn = [
            float(seconds) for seconds in re.findall(rf"{scene}, [^:]+: ([\d.]+) seconds", html)
        ]
        assert len(shown) == len(drawn)
        # The plot has three digits, the table three places.
        for seconds in drawn:
            apart = min(abs(each - seconds) for each in shown)
            assert apart <= max(0.006 * seconds, 0.0006), (form, scene)


# ---------------------------------------------------------------- colours


def _colors(selector: str) -> dict[str, str]:
    text = STYLES.read_text(encoding="utf-8")
    block = text[text.index(selector) :].partition("{")[2].partition("}")[0]
    colors = dict(re.findall(r"--(\w+): (#\w+);", block))
    return {
        name: f"#{''.join(2 * digit for digit in value[1:])}" if len(value) == 4 else value
        for name, value in colors.items()
    }


def _luminance(color: str) -> float:
    channels = [int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    r, g, b = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels)
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


def _contrast(one: str, other: str) -> float:
    light, dark = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize(
    ("selector", "background"),
    [(".convergence {", "#ffffff"), ('body[data-theme="dark"] .convergence {', "#131416")],
)
def test_lines_stand_out_in_both_schemes(selector: str, background: str) -> None:
    colors = _colors(selector)
    for number in range(convergence_plot.STYLES):
        for behind in (background, colors["floor"]):
            assert _contrast(colors[f"s{number}"], behind) >= 4.5, (number, behind)
    assert _contrast(colors["quiet"], background) >= 4.5
    assert _contrast(colors["axis"], background) >= 3


def test_both_ways_to_the_dark_scheme_are_the_same() -> None:
    dark = _colors('body[data-theme="dark"] .convergence {')
    assert dark == _colors('body:not([data-theme="light"]) .convergence {')
    assert set(dark) == set(_colors(".convergence {"))


# ---------------------------------------------------------------- the site


def _text(site: Path, name: str) -> str:
    return (site / f"{name}.html").read_text(encoding="utf-8")


def test_every_page_that_estimates_has_its_plots(site: Path) -> None:
    measured = {*BENCHED, *FURTHER_BENCHED, *OWN}
    assert measured == set(COURSE) - {*EXACT}
    for module in measured:
        plots = [plot for record in convergence.records(module) for plot in record.plots]
        text = _text(site, f"modules/{module}")
        assert text.count('<figure class="convergence">') == len(plots)
        assert text.count('<div class="plot">') == sum(len(plot.axes) for plot in plots)
        assert "<!-- site:" not in text


@pytest.mark.parametrize("name", ["accuracy", "performance"])
def test_the_documents_show_every_module(site: Path, name: str) -> None:
    groups = [group for each in (BENCHED | FURTHER_BENCHED).values() for group in each.groups]
    others = [plot for record in convergence.records("scaling") for plot in record.plots]
    count = len(groups) + len(others) * (name == "performance")
    assert _text(site, name).count('<figure class="convergence">') == count


@contextmanager
def _open(browser: Any, site: Path, **options: Any) -> Iterator[Any]:
    with untroubled(browser, viewport={"width": 390, "height": 800}, **options) as page:
        page.goto((site / "modules" / "soft_shadows.html").as_uri())
        yield page


@pytest.fixture
def page(browser: Any, site: Path) -> Iterator[Any]:
    """The page of a module, on a telephone."""
    with _open(browser, site) as opened:
        yield opened


def test_the_pointer_finds_the_nearest_mark(page: Any) -> None:
    plot = page.locator(".convergence .plot").first
    mark = plot.locator(".curve").nth(1).locator("[data-values]").nth(2)
    plot.scroll_into_view_if_needed()
    box = mark.bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2 + 1, box["y"] + box["height"] / 2 + 1)
    readout = plot.locator(".readout")
    assert readout.inner_text() == mark.get_attribute("data-values")
    assert readout.inner_text().startswith("random: 16 samples")
    shown = readout.bounding_box()
    around = plot.bounding_box()
    assert around["x"] - 1 <= shown["x"]
    assert shown["x"] + shown["width"] <= around["x"] + around["width"] + 1
    assert plot.locator(".ring").count() == 1
    page.mouse.move(1, 1)
    assert readout.inner_text() == ""
    assert plot.locator(".ring").count() == 0


def test_the_arrow_keys_go_from_mark_to_mark(page: Any) -> None:
    plot = page.locator(".convergence .plot").first
    page.evaluate("document.body.focus()")
    # As who tabs into it: focus that is shown.
    page.locator("a[href]").first.focus()
    for _ in range(400):
        page.keyboard.press("Tab")
        if plot.evaluate("plot => plot === document.activeElement"):
            break
    readout = plot.locator(".readout")
    assert readout.get_attribute("aria-live") == "polite"
    names = plot.locator(".curve").count()
    assert readout.inner_text().startswith("regular: 1 sample for")
    # Measured in quick runs up to 64 samples, and up to 1024 in others.
    most = "1,024" if "1,024" in plot.inner_text() else "64"
    for key, told in (
        ("ArrowRight", "regular: 4 samples"),
        ("ArrowDown", "random: 4 samples"),
        ("End", f"random: {most} samples"),
        ("ArrowRight", f"random: {most} samples"),
        ("Home", "random: 1 sample for"),
        ("ArrowLeft", "random: 1 sample for"),
        ("ArrowUp", "regular: 1 sample for"),
        ("ArrowUp", "Sobol: 1 sample for"),
    ):
        page.keyboard.press(key)
        assert readout.inner_text().startswith(told), key
    assert names == 4
    page.keyboard.press("Escape")
    assert readout.inner_text() == ""


def test_without_scripts_the_numbers_are_in_a_table(browser: Any, site: Path) -> None:
    with _open(browser, site, java_script_enabled=False) as page:
        figure = page.locator(".convergence").first
        assert figure.locator("table").is_hidden()
        figure.locator("summary").click()
        assert figure.locator("table").is_visible()
        assert figure.locator(".hint").count() == 0
        assert figure.locator(".plot").first.get_attribute("tabindex") is None


@pytest.mark.parametrize("width", [390, 1280])
def test_letters_are_large_enough_and_nothing_is_cut(page: Any, width: int) -> None:
    page.set_viewport_size({"width": width, "height": 800})
    sizes = page.evaluate(
        """() => [...document.querySelectorAll(".convergence svg:not(.swatch) text")].map((text) =>
        parseFloat(getComputedStyle(text).fontSize) * text.getScreenCTM().a)"""
    )
    assert sizes
    assert min(sizes) >= 11
    over = page.evaluate("document.documentElement.scrollWidth - innerWidth")
    assert over <= 0
