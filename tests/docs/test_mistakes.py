"""Common mistakes and their pictures: every list has its row of figures, and what is wrong looks wrong."""

import os
import re
import signal
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from tests.lengths import share

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

from sitebuild.mistakes import figures, part, rendered
from sitebuild.mistakes.bullets import bullets, plain
from sitebuild.mistakes.catalog import look, look_at, looks
from sitebuild.mistakes.figures import Figure, Studio, draw
from sitebuild.mistakes.look import SIZE
from sitebuild.mistakes.plots import is_plot
from sitebuild.mistakes.submissions import submission
from sitebuild.place import Place

PAGES = PROJECT / "docs" / "modules"

WITHOUT = {("motion_blur.to_object_space", "`displacement` is wrong.")}
"""Bullets that need no picture: what they tell of is another function's mistake."""

MARK = re.compile(r"^<!-- site: mistakes (\S+) (.*) -->$", re.MULTILINE)

ASKED = {
    name: words
    for module in COURSE
    for name, words in MARK.findall((PAGES / f"{module}.md").read_text(encoding="utf-8"))
}
"""The words of each function's part."""


def named(words: str) -> list[str]:
    return [word for word in words.split() if word not in (";", "-")]


@pytest.mark.parametrize("module", COURSE)
def test_a_row_of_figures_follows_each_list(module: str) -> None:
    text = (PAGES / f"{module}.md").read_text(encoding="utf-8")
    lists = re.findall(
        r"^## (\w+)\n(?:(?!## ).*\n)*?Common mistakes:\n\n(?:- .*\n(?: {2}.*\n)*)+\n(.*)$",
        text,
        re.MULTILINE,
    )
    assert len(lists) == text.count("Common mistakes:")
    for function, line in lists:
        assert line.startswith(f"<!-- site: mistakes {module}.{function} "), function


@pytest.mark.parametrize("name", ASKED)
def test_every_bullet_has_a_submission_of_its_function(name: str) -> None:
    module, _, function = name.partition(".")
    for bullet, names in part.of_bullets(name, ASKED[name]):
        assert names or (name, bullet.title) in WITHOUT, bullet.title
        for each in names:
            found = submission(name, each)
            assert (found.module, found.function) == (module, function)
    assert len(named(ASKED[name])) == len(set(named(ASKED[name])))


@pytest.mark.parametrize("name", ASKED)
def test_every_look_is_at_something_that_is_shown(name: str) -> None:
    assert {look_at(name, each) for each in named(ASKED[name])} == set(range(len(looks(name))))
    listed = [each for one in looks(name) for each in one.names]
    assert set(listed) <= set(named(ASKED[name]))
    assert len(set(listed)) == len(listed)
    assert all(file.is_file() for one in looks(name) for file in one.files)


def test_a_part_that_does_not_fit_its_list_is_refused() -> None:
    with pytest.raises(CourseError, match="4 common mistakes, and figures for 1"):
        part.of_bullets("soft_shadows.light_grid", "grid_diagonal")
    with pytest.raises(CourseError, match="soft_shadows has no none"):
        submission("soft_shadows.light_grid", "none")
    with pytest.raises(CourseError, match="is of point_on_sphere"):
        submission("soft_shadows.light_grid", "sphere_half")
    with pytest.raises(CourseError, match="no list of common mistakes in a section 'lights'"):
        bullets("soft_shadows.lights")


def test_titles_and_texts_come_from_the_page() -> None:
    found = bullets("thin_lens.image_distance")
    assert [bullet.title for bullet in found] == [
        "Added instead of subtracted.",
        "The wrong sign, or always positive.",
        "Breaks at the limits.",
    ]
    assert found[2].text == "Infinity divided by infinity is NaN."
    assert plain(r"*Divided* by [that](a.md#b): $2\pi$, `u`") == "Divided by that: 2, u"


class Figures(HTMLParser):
    """Figures of a built page: whether each is right or wrong, its picture and its caption."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str], list[str]]] = []
        self._inside = False
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        kind = given.get("class", "").partition(" ")[0]
        if tag == "figure" and kind in ("right", "wrong"):
            self.found.append((kind, {}, []))
            self._inside = True
        elif tag == "img" and self._inside:
            self.found[-1][1].update(given)

    def handle_endtag(self, tag: str) -> None:
        self._inside = self._inside and tag != "figure"

    def handle_data(self, data: str) -> None:
        if self._inside:
            self.found[-1][2].append(data)


@pytest.mark.parametrize("module", COURSE)
def test_the_built_page_shows_them_all(module: str, site: Path) -> None:
    page = site / "modules" / f"{module}.html"
    found = Figures(page).found
    wanted = [
        f"{name}-{each}.webp"
        for name, words in ASKED.items()
        if name.startswith(f"{module}.")
        for each in named(words)
    ]
    wrong = [picture["src"].rpartition("/")[2] for kind, picture, _ in found if kind == "wrong"]
    assert sorted(wrong) == sorted(wanted)
    assert found[0][0] == "right"
    for kind, picture, caption in found:
        assert (page.parent / picture["src"]).is_file()
        assert picture["loading"] == "lazy"
        assert (int(picture["width"]), int(picture["height"])) == SIZE
        assert len(picture["alt"]) > 20
        assert not re.search(r"[$`*\\]", picture["alt"]), picture["alt"]
        text = " ".join("".join(caption).split())
        assert text.startswith("Right.") == (kind == "right")
        assert "**" not in text
    alternatives = [picture["alt"] for _, picture, _ in found]
    assert len(set(alternatives)) == len(alternatives)


@pytest.mark.parametrize(
    "name", [name for name in ASKED if any(one.renders for one in looks(name))]
)
def test_every_scene_that_is_looked_at_is_a_scene(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A stricter scene file had ended the build of the whole site: pictures are left out of it in other tests."""
    monkeypatch.setattr(rendered, "rendered", lambda *_, **__: np.zeros((3, *SIZE[::-1])))
    for seen, one in enumerate(looks(name)):
        if one.renders:
            draw(Figure(name, "", seen))


def pixels(figure: Figure) -> np.ndarray:
    return np.asarray(draw(figure).convert("RGB").resize(SIZE), np.float64)


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("supersampling.resolve", "resolve_divided_by_count"),
        ("soft_shadows.point_on_sphere", "sphere_centre_forgotten"),
        ("soft_shadows.point_in_ball", "ball_crowded_middle"),
        ("glossy.keep_above", "flipped"),
        ("cube_map.lookup", "nearest"),
        ("adaptive_sampling.needs_subdivision", "brightness"),
        ("bounding_volumes.build", "build_unsorted"),
        ("textures.sphere_uv", "upside_down"),
        ("quasi_monte_carlo.halton", "halton_one_base"),
        ("radiosity.gather", "added_up"),
    ],
)
def test_what_is_wrong_looks_wrong(name: str, wrong: str) -> None:
    pytest.importorskip("matplotlib", reason='plots need: pip install -e ".[bench]"')
    seen = look_at(name, wrong)
    right = Figure(name, "", seen)
    # The same pixels each time: a difference is the mistake's.
    assert np.array_equal(pixels(right), pixels(right))
    assert np.abs(pixels(right) - pixels(Figure(name, wrong, seen))).mean() > 1


@pytest.mark.parametrize(
    "name", share([name for name in ASKED if any(is_plot(one.draw) for one in looks(name))], 3)
)
def test_nothing_that_is_written_in_a_plot_is_cut_off(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    plotting = pytest.importorskip(
        "matplotlib.figure", reason='plots need: pip install -e ".[bench]"'
    )
    drawn: list[Any] = []

    class Kept(plotting.Figure):  # type: ignore[misc, name-defined]
        def __init__(self, **given: Any) -> None:
            super().__init__(**given)
            drawn.append(self)

    monkeypatch.setattr(plotting, "Figure", Kept)
    for seen, one in enumerate(looks(name)):
        if is_plot(one.draw):
            draw(Figure(name, "", seen))
            whole, written = drawn[-1].bbox_inches, drawn[-1].get_tightbbox()
            assert whole.x0 <= written.x0 <= written.x1 <= whole.x1, one.shows
            assert whole.y0 <= written.y0 <= written.y1 <= whole.y1, one.shows
    assert drawn


def test_a_figure_is_drawn_once_and_anew_when_its_sources_change(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("matplotlib", reason='plots need: pip install -e ".[bench]"')
    figure = Figure("sampling.disk_by_polar", "disk_spiral", 0)
    studio = Studio()
    try:
        ((image, note),) = studio.files([figure], tmp_path).values()
    finally:
        studio.close()
    with Image.open(image) as opened:
        assert opened.format == "WEBP"
    assert note == ""
    monkeypatch.setattr(studio, "_draw", lambda paths: pytest.fail(f"drawn again: {paths}"))
    assert studio.files([figure], tmp_path) == {figure: (image, "")}
    key = figure.key
    assert Figure("sampling.disk_by_polar", "", 0).key != key
    monkeypatch.setattr(figures, "_sources", lambda module: f"changed {module}")
    assert figure.key != key


def test_a_function_that_does_not_end_is_given_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("matplotlib", reason='plots need: pip install -e ".[bench]"')
    monkeypatch.setattr(figures, "DRAWN_WITHIN", 0.0)
    figure = Figure("sampling.disk_by_polar", "disk_spiral", 0)
    ((image, note),) = Studio().files([figure], tmp_path).values()
    assert note == "It does not end."
    assert image.is_file()
    with pytest.raises(CourseError, match=r"sampling\.disk_by_polar: no picture in 0 s"):
        Studio().files([Figure("sampling.disk_by_polar", "", 0)], tmp_path)


@pytest.mark.skipif(sys.platform == "win32", reason="a signal of POSIX")
def test_what_draws_figures_is_ended_without_a_complaint() -> None:
    """`course quiz`, ended by another program, had left a warning of semaphores."""
    program = (
        "import time\n"
        "from sitebuild.mistakes.figures import STUDIO\n"
        "if __name__ == '__main__':\n"
        "    STUDIO._draw({})\n"
        "    print('drawing', flush=True)\n"
        "    time.sleep(300)\n"
    )
    command = [sys.executable, "-c", program]
    paths = os.pathsep.join((str(PROJECT), str(PROJECT / "docs")))
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": paths},
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "drawing\n"
        process.terminate()
        _, complained = process.communicate()
    assert process.returncode == 128 + signal.SIGTERM
    assert complained == ""


def test_a_function_that_raises_is_told_in_the_caption(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def raising(_: Figure) -> Image.Image:
        raise ZeroDivisionError("division by zero")

    monkeypatch.setattr(figures, "draw", raising)
    image, note = tmp_path / "a.webp", tmp_path / "a.txt"
    name = "soft_shadows.light_grid"
    figures._drawn(Figure(name, "grid_diagonal", look_at(name, "grid_diagonal")), image, note)
    said = note.read_text(encoding="utf-8")
    assert said == "It ends with ZeroDivisionError: division by zero"
    assert image.is_file()
    # The right function has no such excuse.
    with pytest.raises(ZeroDivisionError):
        figures._drawn(Figure(name, "", 0), image, note)
    monkeypatch.setattr(part.STUDIO, "files", lambda all_: dict.fromkeys(all_, (image, said)))
    shown = part.mistakes(Place("../", False, tmp_path, {}), name, ASKED[name])
    # In the caption and in the text for those who have it read to them.
    assert shown.count(said) == 2 * len(named(ASKED[name]))
    assert look(name, 0).shows in shown
