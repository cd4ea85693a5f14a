"""Figures that can be dragged: the page computes what the course's functions do, and handles follow the pointer."""

import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from tests.browser import tab_to, untroubled

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')
pytest.importorskip("latex2mathml", reason='the site needs: pip install -e ".[docs]"')

from sitebuild.diagrams.movable import Handle, Movement, shown
from sitebuild.diagrams.part import diagram, figure

STATIC = PROJECT / "docs" / "_static"
SCRIPTS = ("drag_models.js", "drag.js")

MOVING: dict[str, Movement] = {
    name: moving.movement
    for module in COURSE
    for name in (
        f"{module}/{each}" for each in import_module(f"sitebuild.diagrams.{module}").FIGURES
    )
    for moving in (figure(name),)
    if moving.movement is not None
}

VECTORS = 200
"""Random values of each model, besides the ends of the ranges."""

ROUND = ("source", "side")
"""Points that go round another one."""

HANDLES = [(name, handle) for name, moves in MOVING.items() for handle in moves.handles]


def vectors(movement: Movement) -> list[dict[str, float]]:
    """Values in their ranges: at rest, all low, all high, and random ones."""
    ranges = movement.values.items()
    found = [movement.start]
    found += [{name: getattr(value, end) for name, value in ranges} for end in ("low", "high")]
    rng = np.random.default_rng(0)
    for _ in range(VECTORS):
        found.append({name: float(rng.uniform(value.low, value.high)) for name, value in ranges})
    return found


@pytest.fixture
def page(browser: Any) -> Iterator[Any]:
    """All figures that can be dragged, and no script yet."""
    styles = (STATIC / "diagrams.css").read_text(encoding="utf-8")
    body = "".join(diagram(None, name) for name in MOVING)  # type: ignore[arg-type]
    with untroubled(browser, viewport={"width": 700, "height": 900}) as opened:
        opened.set_content(f"<!doctype html><style>{styles}</style><body>{body}")
        yield opened


@pytest.fixture
def alive(page: Any) -> Any:
    """The same figures with their scripts."""
    for script in SCRIPTS:
        page.add_script_tag(path=STATIC / script)
    return page


def shape(page: Any, name: str) -> Any:
    return page.locator(f"figure[data-model='{name}']")


def says(text: str, template: str, numbers: dict[str, float]) -> bool:
    """Whether a text is the template with these numbers; where they end in a 5, either way of rounding is right."""
    slots = re.findall(r"\{(\w+):\.(\d)f\}", template)
    words = [re.escape(part) for part in re.split(r"\{\w+:\.\df\}", template)]
    found = re.fullmatch(r"(-?[\d.]+|∞)".join(words), text)
    return found is not None and all(
        said == shown(numbers[name], int(digits))
        or abs(float(said) - numbers[name]) <= 0.5001 * 10 ** -int(digits)
        for said, (name, digits) in zip(found.groups(), slots, strict=True)
    )


def test_five_modules_have_one() -> None:
    assert {name.partition("/")[0] for name in MOVING} == {
        "soft_shadows",
        "thin_lens",
        "glossy",
        "importance_sampling",
        "motion_blur",
    }
    for name, movement in MOVING.items():
        assert movement.name == name
        assert len(figure(name).panels) == 1


@pytest.mark.parametrize("name", MOVING)
def test_the_page_computes_what_the_courses_functions_do(page: Any, name: str) -> None:
    page.add_script_tag(path=STATIC / "drag_models.js")
    tried = vectors(MOVING[name])
    found = page.evaluate(
        "([name, tried]) => tried.map((values) => penumbra.models[name](values))", [name, tried]
    )
    for values, theirs in zip(tried, found, strict=True):
        ours = MOVING[name].model(values)
        assert theirs["numbers"].keys() == ours.numbers.keys()
        assert theirs["points"].keys() == ours.points.keys()
        for key, number in ours.numbers.items():
            assert theirs["numbers"][key] == pytest.approx(number, rel=1e-6, abs=1e-6), (
                key,
                values,
            )
        for key, points in ours.points.items():
            here = np.array(theirs["points"][key], float)
            np.testing.assert_allclose(
                here if here.ndim == 1 else here.T, points, rtol=1e-6, atol=1e-6, err_msg=key
            )


def _places(svg: str) -> list[tuple[str, list[float]]]:
    """Where the elements of a drawing are, but for handles."""
    found = []
    for element in ET.fromstring(re.sub(r' xmlns="[^"]*"', "", svg)).findall("*"):
        if element.tag not in ("title", "desc", "g"):
            names = ("x1", "y1", "x2", "y2", "cx", "cy", "r", "x", "y")
            numbers = [float(element.get(key, "0")) for key in names]
            spots = re.split(r"[ ,]", element.get("points", "0"))
            found.append((element.tag, numbers + [float(spot) for spot in spots]))
    return found


@pytest.mark.parametrize("name", MOVING)
def test_at_rest_the_script_draws_what_the_build_has_drawn(page: Any, name: str) -> None:
    svg = shape(page, name).locator("svg")
    before, read = svg.evaluate("(e) => e.outerHTML"), shape(page, name).inner_text()
    for script in SCRIPTS:
        page.add_script_tag(path=STATIC / script)
    after = svg.evaluate("(e) => e.outerHTML")
    assert svg.get_attribute("role") == "group"
    for (tag, old), (same, new) in zip(_places(before), _places(after), strict=True):
        assert tag == same
        # The build writes a tenth of a unit, the script a hundredth.
        np.testing.assert_allclose(new, old, atol=0.056)
    assert [line for line in read.splitlines() if line] == [
        line
        for line in shape(page, name).inner_text().splitlines()
        if line and not line.startswith("Drag the rings")
    ]


def _knob(page: Any, name: str, handle: Handle) -> Any:
    return shape(page, name).get_by_role("slider", name=handle.name, exact=True)


def _middle(knob: Any) -> tuple[float, float]:
    box = knob.locator(".grip").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@pytest.mark.parametrize(("name", "handle"), HANDLES)
def test_a_handle_follows_the_pointer_and_comes_back(alive: Any, name: str, handle: Handle) -> None:
    knob = _knob(alive, name, handle)
    knob.scroll_into_view_if_needed()
    x, y = _middle(knob)
    was, said = (
        knob.get_attribute("aria-valuetext"),
        shape(alive, name).locator(".readout").inner_text(),
    )
    alive.mouse.move(x + 2, y + 1)
    alive.mouse.down()
    # Downwards to the left, or where that leads nowhere upwards.
    way = np.array([-14, -14 if handle.point == "side" else 14])
    alive.mouse.move(x - 6, y + 9)
    alive.mouse.move(*np.add((x + 2, y + 1), way))
    moved = np.subtract(_middle(knob), (x, y))
    if len(handle.keys) == 2:
        np.testing.assert_allclose(moved, way, atol=0.1)
    elif handle.point not in ROUND:
        assert np.abs(moved - way).min() < 0.1
    # As near as the handle can come.
    assert moved @ way > 60
    assert knob.get_attribute("aria-valuetext") != was
    assert shape(alive, name).locator(".readout").inner_text() != said
    alive.mouse.move(x + 2, y + 1)
    alive.mouse.up()
    assert knob.get_attribute("aria-valuetext") == was
    assert shape(alive, name).locator(".readout").inner_text() == said
    # The pointer has let go.
    alive.mouse.move(x + 40, y + 40)
    np.testing.assert_allclose(_middle(knob), (x, y), atol=0.1)


@pytest.mark.parametrize(("name", "handle"), HANDLES)
def test_arrow_keys_take_steps_within_the_range(alive: Any, name: str, handle: Handle) -> None:
    movement, knob = MOVING[name], _knob(alive, name, handle)
    knob.focus()
    values = dict(movement.start)
    across, up = handle.keys[0], handle.keys[-1]
    ways = (
        ("ArrowRight", across, 1),
        ("ArrowUp", up, 1),
        ("ArrowLeft", across, -1),
        ("Shift+ArrowDown", up, -10),
        ("End", across, np.inf),
        ("Home", across, -np.inf),
    )
    for key, changed, steps in ways:
        alive.keyboard.press(key)
        value = movement.values[changed]
        wanted = values[changed] + steps * value.step
        values[changed] = float(np.clip(wanted, value.low, value.high))
        numbers = movement.model(values).numbers | values
        assert says(knob.get_attribute("aria-valuetext"), handle.says, numbers), key
        now = float(knob.get_attribute("aria-valuenow"))
        assert now == pytest.approx(values[across], abs=1e-6)
        low, high = (float(knob.get_attribute(f"aria-value{end}")) for end in ("min", "max"))
        assert low <= now <= high
        for output in shape(alive, name).locator("[data-number]").all():
            number = movement.model(values).numbers[output.get_attribute("data-number")]
            digits = output.get_attribute("data-digits")
            assert says(output.inner_text(), f"{{it:.{digits}f}}", {"it": number})
    shape(alive, name).get_by_role("button", name="As at first").click()
    rest = movement.model(movement.start).numbers | movement.start
    assert says(knob.get_attribute("aria-valuetext"), handle.says, rest)


def test_the_tab_key_reaches_all_handles(alive: Any) -> None:
    reached = []
    for _ in HANDLES:
        tab_to(alive, "[role=slider]")
        reached.append(alive.evaluate("document.activeElement.getAttribute('aria-label')"))
        if len(reached) in np.cumsum([len(moves.handles) for moves in MOVING.values()]):
            alive.keyboard.press("Tab")
    assert reached == [handle.name for _, handle in HANDLES]


def test_a_finger_can_take_a_handle(alive: Any) -> None:
    for knob in alive.locator(".handle").all():
        box = knob.locator(".reach").bounding_box()
        assert min(box["width"], box["height"]) >= 24
        assert knob.evaluate("(e) => getComputedStyle(e).touchAction") == "none"


@pytest.mark.parametrize("name", MOVING)
def test_a_point_that_is_dragged_belongs_to_the_model(name: str) -> None:
    movement: Movement = MOVING[name]
    for handle in movement.handles:
        assert np.shape(movement.model(movement.start).points[handle.point]) == (2,)
        assert set(handle.keys) <= movement.values.keys()
    for value in movement.values.values():
        assert value.low < value.start < value.high


def test_pages_have_them_and_their_scripts(browser: Any, site: Path) -> None:
    for name in MOVING:
        with untroubled(browser, viewport={"width": 390, "height": 800}) as opened:
            opened.goto((site / "modules" / f"{name.partition('/')[0]}.html").as_uri())
            assert opened.locator(f"figure[data-model='{name}'].draggable").count() == 1
            assert opened.evaluate("document.documentElement.scrollWidth") <= 390


def test_slides_keep_to_their_place_while_a_handle_moves(browser: Any, site: Path) -> None:
    with untroubled(browser, viewport={"width": 1280, "height": 720}) as opened:
        opened.goto(f"{(site / 'modules' / 'thin_lens.html').as_uri()}?slides")
        opened.wait_for_selector(".deck .slide.now")
        for _ in range(30):
            if opened.locator(".slide.now .handle").count():
                break
            opened.keyboard.press("ArrowRight")
        address, knob = opened.url, opened.locator(".slide.now .handle").first
        was = knob.get_attribute("aria-valuetext")
        knob.focus()
        opened.keyboard.press("ArrowLeft")
        assert opened.url == address
        assert knob.get_attribute("aria-valuetext") != was
