"""The walk through a hierarchy on the page is the one of the course's traverse, and its steps can be leafed through."""

import re
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from solutions import bounding_volumes as course
from tests.browser import untroubled

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')
pytest.importorskip("latex2mathml", reason='the site needs: pip install -e ".[docs]"')

from sitebuild.diagrams import bounding_volumes, walk
from sitebuild.diagrams.canvas import unit
from sitebuild.walk import walk_steps

TREE = bounding_volumes.hierarchy()
WAYS = [
    ((-0.95, 0.5), (2.4, 0.7)),
    ((-0.95, 0.15), (2.4, 0.75)),
    ((2.4, 0.2), (-0.95, 1.1)),
    ((0.4, -0.15), (0.7, 1.3)),
]


def traversed() -> tuple[int, float, int, int]:
    """What `traverse` says of the same ray.

    The drawing is flat. So each triangle becomes a wall across it, a triangle in space whose section is the side by
    which the ray comes in; where it meets none of them, a wall that it misses.
    """
    walls = np.zeros((3, 3, bounding_volumes.COUNT))
    for k in range(bounding_volumes.COUNT):
        a, b = walk.crossings().get(k, (np.array([9.0, 9.0]), np.array([9.1, 9.0])))
        middle = (a + b) / 2
        walls[0, :, k] = (*(2 * a - middle), -1)
        walls[1, :, k] = (*(2 * b - middle), -1)
        walls[2, :, k] = (*middle, 1)
    way = np.append(unit(walk.TARGET - walk.ORIGIN), 0)[:, None]
    found = course.traverse(TREE, *walls, np.append(walk.ORIGIN, 0)[:, None], way)
    triangle, t, boxes, triangles = (array[0] for array in found)
    return int(triangle), float(t), int(boxes), int(triangles)


@pytest.mark.parametrize(("origin", "target"), WAYS)
def test_the_walk_is_the_one_of_traverse(
    origin: tuple[float, float], target: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(walk, "ORIGIN", np.array(origin))
    monkeypatch.setattr(walk, "TARGET", np.array(target))
    last = walk.walk(TREE)[-1]
    triangle, t, boxes, triangles = traversed()
    assert last.nearest == triangle
    assert last.t == pytest.approx(t, rel=1e-12)
    assert len(last.asked) == boxes
    assert len(last.triangles) == triangles
    assert last.stack == ()


def test_the_shown_walk_has_something_of_everything() -> None:
    said = " ".join(step.words for step in walk.walk(TREE))
    for part in ("meets both", "neither", "It hits E", "is skipped"):
        assert part in said


def test_each_step_takes_the_top_of_the_stack() -> None:
    steps = walk.walk(TREE)
    for before, after in pairwise(steps):
        assert after.node == before.stack[-1]
        assert after.stack[: len(before.stack) - 1] == before.stack[:-1]
        assert before.asked <= after.asked


def test_drawings_tell_those_who_do_not_see_them() -> None:
    html = walk_steps(None, "bounding_volumes", "A walk.")  # type: ignore[arg-type]
    assert "\n\n" not in html.rstrip("\n")
    drawings = [ET.fromstring(svg) for svg in re.findall(r"<svg .*?</svg>", html, re.DOTALL)]
    titles = [drawing.findtext("title") for drawing in drawings]
    assert len(set(titles)) == len(titles) == 2 * len(walk.walk(TREE))
    ids = re.findall(r' id="([^"]+)"', html)
    assert len(set(ids)) == len(ids)


def _seen(page: Any) -> list[str]:
    return [
        text.inner_text()
        for text in page.locator("#walk-bounding_volumes .frame > p").all()
        if text.is_visible()
    ]


def test_steps_are_leafed_through_by_keyboard(browser: Any, site: Path) -> None:
    steps = walk.walk(TREE)
    for width in (390, 1280):
        with untroubled(browser, viewport={"width": width, "height": 900}) as page:
            page.goto((site / "modules" / "bounding_volumes.html").as_uri())
            slider = page.locator("#walk-bounding_volumes input")
            slider.focus()
            for k, step in enumerate(steps):
                assert slider.get_attribute("aria-valuetext") == f"{k} of {len(steps) - 1}"
                (seen,) = _seen(page)
                assert seen.startswith(step.words)
                page.keyboard.press("ArrowRight")
            assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_without_scripts_all_steps_are_seen(browser: Any, site: Path) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((site / "modules" / "bounding_volumes.html").as_uri())
    assert len(_seen(page)) == len(walk.walk(TREE))
    context.close()
