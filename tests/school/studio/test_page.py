"""The page of the studio in a browser: by keyboard and by hand, light and dark, wide and narrow."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic
from typing import Any

import pytest

from course.engine.functions.modules import COURSE
from course.school.studio.server import Server
from course.school.studio.studio import Studio
from tests.browser import tab_to
from tests.lengths import share
from tests.school.studio.conftest import RIGHT, SCENE, WRONG, until, write

# Where many tests run at once, a process is long in starting.
pytestmark = pytest.mark.timeout(900)


@contextmanager
def opened(browser: Any, studio: Studio, **options: Any) -> Iterator[Any]:
    """The page, which may complain of nothing and ask nobody but the studio."""
    server = Server(studio)
    context = browser.new_context(viewport={"width": 1280, "height": 900}, **options)
    page = context.new_page()
    trouble: list[str] = []
    page.on("pageerror", lambda error: trouble.append(str(error)))
    page.on("console", lambda said: trouble.append(said.text) if said.type == "error" else None)
    own = f"http://127.0.0.1:{server.port}/"
    page.on(
        "request",
        lambda asked: None if asked.url.startswith((own, "data:")) else trouble.append(asked.url),
    )
    page.goto(server.address)
    yield page
    context.close()
    server.close()
    assert trouble == []


def ready(page: Any, side: str = "mine") -> None:
    """Wait until nothing is rendered any more, and the picture of that side is drawn."""
    until(
        lambda: page.evaluate(
            "side => document.body.dataset.state === 'ready' && /^[0-9]+ samples/"
            ".test(document.getElementById(`${side}-told`).textContent)"
            " && Number(document.getElementById(side).dataset.drawn) > 0",
            side,
        )
    )


def pixels(page: Any, name: str) -> str:
    """What a canvas shows; pictures come a moment after what is told of them."""
    shown: str = page.evaluate("name => document.getElementById(name).toDataURL()", name)
    return shown


def text(page: Any, selector: str) -> str:
    return str(page.inner_text(selector))


def state(page: Any) -> str:
    """Of the function that is written."""
    return str(page.get_attribute("[data-function='soft_shadows.point_on_sphere']", "data-state"))


NOTHING = (
    "No difference between your picture and the reference, of 16 and 64 samples a pixel but noise."
)


@pytest.mark.usefixtures("checked")
def test_a_student_saves_what_is_wrong_and_then_what_is_right(
    browser: Any, studio: Studio, work: Path
) -> None:
    with opened(browser, studio) as page:
        modules = len(COURSE)
        until(lambda: f"Checking: 0 of {modules} modules are done" in text(page, "#points"))
        ready(page)
        assert text(page, "#title") == "A ball (ball.yaml)"
        assert text(page, "#verdict") == NOTHING
        first = pixels(page, "mine")
        until(lambda: state(page) == "to do")
        write(work, WRONG)
        until(lambda: "by more than noise" in text(page, "#verdict"))
        ready(page)
        until(lambda: pixels(page, "mine") != first)
        until(lambda: state(page) == "wrong")
        assert "course check soft_shadows --only point_on_sphere/" in text(page, "#modules")
        assert page.locator("#curve polyline").count() == 2
        difference = pixels(page, "difference")
        page.select_option("#which", "change")
        until(lambda: "your picture now and before the last save" in text(page, "#verdict"))
        page.select_option("#which", "difference")
        write(work, "return center / radius['a']\n")
        until(lambda: "soft_shadows.point_on_sphere" in text(page, "#mine-trouble"))
        write(work, RIGHT)
        until(lambda: text(page, "#verdict") == NOTHING)
        assert page.is_hidden("#mine-trouble")
        until(lambda: pixels(page, "difference") != difference)
        until(lambda: state(page) == "right")
        # While some are being checked the sum isn't told as if it were one of all.
        assert re.fullmatch(
            r"Checking: [1-9][0-9]* of [0-9]+ modules are done, [1-9].* points so far\.|[1-9].* points in all .*",
            text(page, "#points"),
        )


GOES_WRONG = {
    "an endless loop": ("while True:\n    pass\n", "point_on_sphere has been running for"),
    "a crash": ("import ctypes\nctypes.string_at(0)\n", "process ended: segmentation fault"),
    "1 GB of prints": (
        f"for _ in range(1 << 14):\n    print('x' * (1 << 16))\n{RIGHT}",
        "it printed more than 64 MB",
    ),
    "a NaN": (f"{RIGHT.replace('return ', 'return np.nan * ')}", "soft_shadows.point_on_sphere"),
}
"""What a function may do, and what the page then says."""

SAID_WITHIN, TRIES = 2.0, 5
"""Seconds from the save to the page; the fastest of some tries counts, for other work takes the processors at times."""


@pytest.mark.usefixtures("checked")
@pytest.mark.parametrize("what", share([*GOES_WRONG], 4))
def test_what_goes_wrong_is_said_within_two_seconds_and_the_page_goes_on(
    browser: Any, studio: Studio, work: Path, what: str
) -> None:
    body, said = GOES_WRONG[what]
    seconds: list[float] = []
    with opened(browser, studio) as page:
        write(work, RIGHT)
        until(lambda: studio.mine is not None and studio.mine.called)
        while len(seconds) < TRIES and min(seconds, default=SAID_WITHIN) >= SAID_WITHIN:
            ready(page)
            # A student saves after the process that waits for it is ready.
            until(lambda: studio.mine is not None and studio.mine.spare_ready)
            began = monotonic()
            write(work, body)
            page.wait_for_function(
                "said => document.getElementById('mine-trouble').textContent.includes(said)",
                arg=said,
                polling="raf",
                timeout=280_000,
            )
            seconds.append(monotonic() - began)
            # The other picture is there, and tells its pixels.
            page.locator("#course").click(position={"x": 40, "y": 40})
            until(lambda: "With the course's functions" in text(page, "#story"))
            page.evaluate("document.getElementById('story').replaceChildren()")
            write(work, RIGHT)
            until(lambda: text(page, "#verdict").startswith("No difference between"))
            assert page.is_hidden("#mine-trouble")
    assert min(seconds) < SAID_WITHIN, seconds


def test_a_click_tells_a_pixels_story_and_a_drag_orbits(browser: Any, studio: Studio) -> None:
    with opened(browser, studio) as page:
        ready(page)
        before = pixels(page, "mine")
        box = page.locator("#mine").bounding_box()
        page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.locator("#story .rays canvas").wait_for()
        assert page.get_attribute("#story", "data-pixel") == "36,24"
        assert "With your functions, pixel 36,24 of ball.yaml" in text(page, "#story .reason")
        assert page.locator("#story .rays circle.sample").count() == 16
        assert page.locator("#story .beside").count() == 0
        page.mouse.move(box["x"] + 50, box["y"] + 50)
        page.mouse.down()
        page.mouse.move(box["x"] + 150, box["y"] + 60, steps=5)
        # The picture follows the mouse, and what belongs to the view before says so.
        until(lambda: pixels(page, "mine") != before)
        assert page.is_enabled("#reset")
        page.mouse.up()
        until(lambda: page.get_attribute("#story", "class") != "old")
        until(lambda: page.get_attribute("#difference", "class") != "old")
        assert "See its rays below" in text(page, "#asked")
        page.click("#reset")
        until(lambda: page.is_disabled("#reset"))
        until(lambda: pixels(page, "mine") == before)


def test_a_pixel_shows_the_courses_rays_beside_wrong_ones(
    browser: Any, studio: Studio, work: Path
) -> None:
    write(work, WRONG)
    with opened(browser, studio) as page:
        until(lambda: "by more than noise" in text(page, "#verdict"))
        ready(page)
        page.locator("#mine").click(position={"x": 80, "y": 150})
        page.locator("#story .beside li").first.wait_for()
        assert "point_on_sphere departs from the course's function" in text(page, "#story .beside")
        both = page.locator("#story .rays input[type=radio]")
        assert both.count() == 3
        assert page.locator("#story .rays svg line.right").count() > 0
        canvas = "document.querySelector('#story .rays canvas').toDataURL()"
        before = page.evaluate(canvas)
        both.nth(2).check()
        until(lambda: page.evaluate(canvas) != before)
        # Where the difference is red or blue, one clicks: it is the same pixel.
        page.locator("#difference").click(position={"x": 100, "y": 150})
        place = page.evaluate(
            "(box => [Math.floor(100 / box.width * 72), Math.floor(150 / box.height * 48)].join())"
            "(document.getElementById('difference').getBoundingClientRect())"
        )
        until(lambda: page.get_attribute("#story", "data-pixel") == place)
        page.locator("#story .beside li").first.wait_for()
        # A save is told of by the same pixel.
        write(work, RIGHT)
        until(lambda: "The course's functions send the same rays." in text(page, "#story"))
        assert page.get_attribute("#story", "data-pixel") == place


WRONG_GRID = """\
u, v = np.meshgrid(np.arange(k) / k, np.arange(k) / k)
offset = 3 * edge_u[:, None] * u.ravel() + edge_v[:, None] * v.ravel()
return (corner[:, None] + offset).astype(np.float32)
"""


def test_a_function_that_was_asked_before_there_was_a_ray_is_named(
    browser: Any, studio: Studio, work: Path
) -> None:
    write(work, WRONG_GRID, "light_grid")
    ball = "{type: sphere, center: [-2, 3, 2], radius: 0.8, intensity: 30}"
    lamp = (
        "{type: rectangle, corner: [-2, 3, 2], edge_u: [1, 0, 0], edge_v: [0, 0, 1],"
        " intensity: 30, samples: grid 2}"
    )
    (work / "ball.yaml").write_text(SCENE.replace(ball, lamp), encoding="utf-8")
    with opened(browser, studio) as page:
        until(lambda: "by more than noise" in text(page, "#verdict"))
        ready(page)
        page.locator("#mine").click(position={"x": 80, "y": 150})
        page.locator("#story .beside li").first.wait_for()
        said = text(page, "#story .beside")
        assert "Where soft_shadows.light_grid departs from the course's function" in said
        assert "While the scene was built soft_shadows.light_grid returned" in said
        assert page.locator("#story .rays input[type=radio]").count() == 3


def test_two_tabs_show_the_same(browser: Any, studio: Studio, work: Path) -> None:
    with opened(browser, studio) as page:
        other = page.context.new_page()
        other.goto(page.url)
        for each in (page, other):
            ready(each)
        write(work, WRONG)
        for each in (page, other):
            until(lambda each=each: "by more than noise" in text(each, "#verdict"))
            ready(each)
        label = other.locator("label", has_text="lights[0].radius")
        label.locator("input").focus()
        for _ in range(5):
            other.keyboard.press("ArrowLeft")
        moved = until(lambda: label.locator("output").inner_text() != "0.8" and label.inner_text())
        until(lambda: page.locator("label", has_text="lights[0].radius").inner_text() == moved)
        other.close()
        ready(page)
        page.click("#reset")
        until(lambda: page.is_disabled("#reset"))


def test_a_page_that_slept_catches_up(browser: Any, studio: Studio, work: Path) -> None:
    with opened(browser, studio) as page:
        ready(page)
        page.locator("#mine").click(position={"x": 80, "y": 150})
        page.locator("#story .rays circle.sample").nth(3).click()
        # As where a machine sleeps: the stream of what happens ends, and the browser asks for another one.
        studio._say("gone", None)
        until(lambda: "doesn't answer" in text(page, "#status"))
        write(work, WRONG)
        until(lambda: "by more than noise" in text(page, "#verdict"))
        ready(page)
        # The pixel is told anew, for the functions are; otherwise what was chosen stays.
        until(lambda: page.locator("#story .beside li").count() > 0)
        page.locator("#story .rays circle.sample").nth(3).click()
        seen = text(page, "#story .told")
        studio._say("gone", None)
        until(lambda: "doesn't answer" in text(page, "#status"))
        until(lambda: text(page, "#status") == "ready")
        assert text(page, "#story .told") == seen
        assert page.locator("#story circle.sample.chosen").count() == 1


def test_the_keyboard_does_everything(browser: Any, studio: Studio) -> None:
    with opened(browser, studio) as page:
        ready(page)
        for key in ("ArrowLeft", "+"):
            before = pixels(page, "mine")
            tab_to(page, "#mine")
            page.keyboard.press(key)
            until(lambda before=before: pixels(page, "mine") != before)
        ready(page)
        before = pixels(page, "mine")
        label = page.locator("label", has_text="lights[0].radius")
        name = label.get_attribute("for")
        tab_to(page, f"#{name}")
        for _ in range(10):
            page.keyboard.press("ArrowLeft")
        until(lambda: label.locator("output").inner_text().startswith("0.7"))
        until(lambda: pixels(page, "mine") != before)
        tab_to(page, "#x")
        page.keyboard.type("20")
        page.keyboard.press("Enter")
        page.locator("#story .rays canvas").wait_for()


def test_a_view_writes_its_camera_only_when_asked(browser: Any, viewer: Studio, work: Path) -> None:
    with opened(browser, viewer) as page:
        ready(page, "course")
        assert page.is_hidden("#mine")
        assert page.is_hidden("nav")
        page.focus("#course")
        before = pixels(page, "course")
        page.keyboard.press("ArrowRight")
        until(lambda: pixels(page, "course") != before)
        page.click("#yaml")
        until(lambda: text(page, "#view-yaml").startswith("camera:\n  eye: ["))
        assert sorted(file.name for file in work.glob("*.yaml")) == ["ball.yaml"]
        page.click("#save")
        until(lambda: text(page, "#view-told") == "ball-view-1.yaml was written")
        written = (work / "ball-view-1.yaml").read_text(encoding="utf-8")
        eye = text(page, "#view-yaml").splitlines()[1].strip()
        assert f"camera: {{{eye}, look_at" in written
        assert "# The lamp." in written


@pytest.mark.usefixtures("checked")
def test_axe_finds_nothing_and_a_telephone_is_wide_enough(
    browser: Any, studio: Studio, work: Path
) -> None:
    accessibility = pytest.importorskip("tests.docs.test_accessibility")
    write(work, WRONG)
    # Axe is put into the page, which takes no scripts but its own.
    with opened(browser, studio, bypass_csp=True, color_scheme="dark") as page:
        ready(page)
        until(lambda: state(page) == "wrong")
        page.fill("#x", "20")
        page.click("#pixel-form button")
        page.locator("#story .rays canvas").wait_for()
        page.click("#yaml")
        page.click("#others summary")
        for width in (1280, 390):
            page.set_viewport_size({"width": width, "height": 844})
            for scheme in ("dark", "light"):
                page.emulate_media(color_scheme=scheme)
                assert page.evaluate("document.documentElement.scrollWidth") <= width
                assert accessibility._faults(page, accessibility.COLOURS) == []
            assert accessibility._faults(page, accessibility.RULES) == []
