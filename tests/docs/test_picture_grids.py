"""Pictures in rows and columns: each is the one that its command makes, and stands where its caption says."""

import json
import re
import shlex
from html import unescape
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from course.cli.main import commands
from course.engine.functions.effects import PROJECT
from course.engine.radiosity import radiosity
from tests.browser import untroubled

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

from sitebuild import (
    other_shots,
    parts,
    pictures,
    radiosity_pictures,
    radiosity_scrubber,
    series_grid,
    series_pictures,
)
from sitebuild.picture_grid import Cell, grid
from sitebuild.place import Place

SIZE = (32, 32)

CORNER = """\
title: A corner
camera: {eye: [0, 0.8, 4], look_at: [0, 0.4, 0]}
film: {width: 32, height: 32}
materials: {grey: {color: 0.7}}
lights: [{type: rectangle, corner: [-0.2, 1, -0.2], edge_u: [0.4, 0, 0], edge_v: [0, 0, 0.4], radiance: 5}]
objects:
  - {shape: quad, material: grey, width: 2, depth: 2}
  - shape: quad
    material: grey
    width: 2
    depth: 2
    transform: [{rotate: {axis: [1, 0, 0], degrees: 90}}, {translate: [0, 1, -1]}]
"""
"""A floor and a wall; few triangles make a quick test."""


@pytest.fixture(scope="module")
def corner(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which the scene lies, and what is kept of its pictures by whoever asks first."""
    folder = tmp_path_factory.mktemp("corner")
    (folder / "scenes").mkdir()
    (folder / "scenes" / "corner.yaml").write_text(CORNER, encoding="utf-8")
    return folder


@pytest.fixture
def small(corner: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Few patches, small pictures, and a folder of their own for what is kept."""
    monkeypatch.chdir(corner)
    monkeypatch.setattr(pictures, "KEPT", corner / "kept")
    monkeypatch.setattr(radiosity_pictures, "SIZE", SIZE)
    monkeypatch.setattr(radiosity_pictures, "GATHERED", 16)
    monkeypatch.setattr(radiosity_pictures, "SHOT", 400)
    monkeypatch.setattr(radiosity_pictures, "FLOWN", 16)
    monkeypatch.setattr(radiosity_pictures, "FRAMES", 4)
    monkeypatch.setattr(other_shots, "PROJECT", corner)
    monkeypatch.setattr(pictures, "scene_path", (corner / "scenes" / "corner.yaml").with_stem)
    return corner


def _place(folder: Path, *, blank: bool = False) -> Place:
    return Place("", blank=blank, made=folder / "made", files={})


def _commands(html: str) -> list[list[str]]:
    found = re.findall(r"<code>(course .*?)</code>", html)
    return [shlex.split(unescape(line))[1:] for line in found]


def _run(words: list[str]) -> None:
    done = CliRunner().invoke(commands, words)
    assert done.exit_code == 0, done.output


def _as_kept(path: Path) -> bytes:
    encoded = BytesIO()
    with Image.open(path) as image:
        image.convert("RGB").save(encoded, "WEBP", quality=pictures.QUALITY)
    return encoded.getvalue()


def test_iterations_stand_above_shots(small: Path) -> None:
    place = _place(small)
    html = radiosity_pictures.radiosity_steps(place, "corner", "Above, below.")
    # Captions and the empty place, in the order of the grid.
    assert re.findall(r"<span>(.*?)</span>|(class=\"empty\")", html) == [
        ("0 iterations: the lamp alone", ""),
        ("1 iteration", ""),
        ("32 iterations", ""),
        ("320 iterations", ""),
        ("", 'class="empty"'),
        ("1 shot", ""),
        ("32 shots", ""),
        ("320 shots", ""),
    ]
    assert "Above, below." in html
    light = []
    for address in re.findall(r'<img src="(.*?)"', html):
        with Image.open(place.files[address]) as image:
            assert image.size == SIZE
            light.append(int(np.asarray(image.convert("L")).astype(int).sum()))
    none, first, later, last, one, some, many = light
    assert none < first < later
    assert later == last
    assert one < some < many < later


def test_the_last_of_each_row_is_what_its_command_makes(small: Path) -> None:
    place = _place(small)
    html = radiosity_pictures.radiosity_steps(place, "corner", "")
    for words, name in zip(_commands(html), ("gather-320", "shoot-320"), strict=True):
        _run(words)
        kept = place.files[f"_radiosity/corner-{name}.webp"].read_bytes()
        assert _as_kept(small / "room.png") == kept, name


def test_a_flight_is_what_its_commands_make(small: Path) -> None:
    place = _place(small)
    html = radiosity_pictures.radiosity_flight(place, "corner", "A flight.")
    for words in _commands(html):
        _run(words)
    seen = set()
    for number in range(4):
        kept = place.files[f"_radiosity/corner-flight-{number}.webp"].read_bytes()
        assert _as_kept(small / f"flight_{number:03}.png") == kept, number
        seen.add(kept)
    assert len(seen) == 4
    assert html.index("frame 1<") < html.index("frame 4<")


def test_pictures_under_sliders_are_what_their_commands_make(
    small: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(radiosity_scrubber, "ITERATIONS", (0, 2, 3))
    monkeypatch.setattr(radiosity_scrubber, "SHOTS", (1, 10))
    solved = []
    gathering = radiosity.solve_patches
    monkeypatch.setattr(
        radiosity, "solve_patches", lambda *asked: solved.append(asked) or gathering(*asked)
    )
    place = _place(small)
    html = radiosity_scrubber.radiosity_scrubber(place, "corner", "They gather. | They shoot.")
    # The iterations are those of one solution.
    assert [asked[4] for asked in solved].count("gather") == 1
    assert [text.strip() for text in re.findall(r"<figcaption>(.*?)\n", html)] == [
        "They gather.",
        "They shoot.",
    ]
    sliders = [json.loads(unescape(each)) for each in re.findall(r'data-sliders="(.*?)"', html)]
    assert [slider["words"] for (slider,) in sliders] == [["0", "2", "3"], ["1", "10"]]
    lines = [unescape(unescape(each)) for each in re.findall(r'data-same="(&lt;.*?)"', html)]
    seen = set()
    names = ("gather-0", "gather-2", "gather-3", "shoot-1", "shoot-10")
    for line, name in zip(lines, names, strict=True):
        _run(shlex.split(re.sub("</?code>", "", line))[1:])
        kept = place.files[f"_radiosity/corner-{name}.webp"].read_bytes()
        assert _as_kept(small / "room.png") == kept, name
        seen.add(kept)
    assert len(seen) == len(names)


def test_sliders_go_through_iterations_and_shots(browser: Any, site: Path) -> None:
    with untroubled(browser, viewport={"width": 390, "height": 800}) as page:
        page.goto((site / "modules" / "radiosity.html").as_uri())
        for name, method, counts in (
            ("iterations", "gather", radiosity_scrubber.ITERATIONS),
            ("shots", "shoot", radiosity_scrubber.SHOTS),
        ):
            figure = page.locator(f"#{name}-radiosity")
            slider = figure.get_by_label(name)
            slider.focus()
            for count in counts:
                assert slider.get_attribute("aria-valuetext") == f"{count:,}"
                shown = figure.locator("img:visible")
                assert shown.get_attribute("src").endswith(f"radiosity-{method}-{count}.webp")
                assert f"--iterations {count} " in figure.locator(".same").inner_text()
                page.keyboard.press("ArrowRight")
        assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_a_room_is_worked_out_once(small: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = [
        part(_place(small), "corner", "")
        for part in (radiosity_pictures.radiosity_steps, radiosity_pictures.radiosity_flight)
    ]
    monkeypatch.setattr(radiosity_pictures, "_seen", None)
    again = [
        part(_place(small), "corner", "")
        for part in (radiosity_pictures.radiosity_steps, radiosity_pictures.radiosity_flight)
    ]
    assert made == again
    # Another number of patches is another picture.
    monkeypatch.setattr(radiosity_pictures, "GATHERED", 17)
    with pytest.raises(TypeError):
        radiosity_pictures.radiosity_steps(_place(small), "corner", "")


def test_grey_pictures_are_not_worked_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(other_shots, "kept_picture", None)
    place = _place(tmp_path, blank=True)
    radiosity_pictures.radiosity_steps(place, "radiosity", "")
    radiosity_pictures.radiosity_flight(place, "radiosity", "")
    assert len(place.files) == 7 + radiosity_pictures.FRAMES
    for path in place.files.values():
        with Image.open(path) as image:
            assert image.size == radiosity_pictures.SIZE


def test_rays_are_rows_and_bounces_are_columns(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = []

    def picture(_: object, step: tuple[int, ...]) -> Path:
        asked.append(step)
        return tmp_path / f"{step}"

    monkeypatch.setattr(series_pictures, "picture", picture)
    place = _place(tmp_path)
    html = series_grid.series_grid(place, "path_tracing_rays")
    assert asked == [(row, column) for row in range(3) for column in range(3)]
    assert re.findall(r"<span>(.*?)</span>", html) == [
        f"{samples}, {bounces}"
        for samples in ("1 sample", "16 samples", "64 samples")
        for bounces in ("1 bounce", "3 bounces", "100 bounces")
    ]
    assert 'style="--columns: 3"' in html
    assert "<code>integrator.max_depth: 100</code>" in html
    ((*_, samples, _, _),) = _commands(html)
    assert samples == "64"
    assert list(place.files.values()) == [tmp_path / f"{step}" for step in asked]


def test_words_of_a_grid_are_no_markup() -> None:
    html = grid("g", "a < b", 2, [Cell("x.webp", "c & d", 'e "f"', (3, 2)), None], "<code>y</code>")
    assert "a &lt; b" in html
    assert "c &amp; d" in html
    assert 'alt="e &quot;f&quot;" width="3" height="2" loading="lazy"' in html
    assert html.count('class="empty"') == 1
    # An empty line would end the block in Markdown.
    assert "\n\n" not in html


@pytest.mark.parametrize(
    ("page", "kinds"),
    [
        ("radiosity", {"radiosity_steps", "radiosity_scrubber", "radiosity_flight"}),
        ("path_tracing", {"series_grid"}),
    ],
)
def test_pages_show_them(page: str, kinds: set[str]) -> None:
    text = (PROJECT / "docs" / "modules" / f"{page}.md").read_text(encoding="utf-8")
    assert kinds <= {match[1] for match in parts.MARK.finditer(text)}
    assert kinds <= parts.PARTS.keys()


def test_four_are_two_beside_each_other_on_a_phone(browser: object, site: Path) -> None:
    where = "[...document.querySelectorAll('#steps-radiosity .frame')].map((f) => f.offsetTop)"
    for width, columns in ((1280, 4), (390, 2)):
        page = browser.new_page(viewport={"width": width, "height": 900})  # type: ignore[attr-defined]
        page.goto((site / "modules" / "radiosity.html").as_uri())
        tops = page.evaluate(where)
        assert tops.count(tops[0]) == columns
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        page.close()
