"""Series of pictures: every step is a scene, its picture is the one that its command renders, and sliders show it."""

import shlex
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any

import click
import pytest
import yaml
from click.testing import CliRunner
from PIL import Image

from course import Picture, Scene, render
from course.base.errors import CourseError
from course.cli.main import commands
from course.engine.formats.yaml.loading import load_description
from course.engine.formats.yaml.overriding import Overrides
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_variant
from tests.browser import tab_to, untroubled

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

from sitebuild import pictures, series_file, series_pictures, webp

SERIES = series_file.read(series_file.FILE.read_text(encoding="utf-8"))

SCENE = """\
title: A ball
camera: {eye: [0, 0, 4], look_at: [0, 0, 0]}
film: {width: 1200, height: 300}
sampler: {samples: 2}
materials: {grey: {}}
lights: [{type: sphere, center: [0, 3, 3], radius: 0.1, intensity: 20}]
objects: [{shape: sphere, material: grey, segments: 16}]
"""

TWO = """\
ball:
  scene: ball
  size: [40, 30]
  samples: 4
  title: A ball
  alt: "A ball, {pattern}, with {samples}."
  sliders:
    - {name: samples, key: [sampler, samples], values: [1, 4], start: 1}
    - {name: pattern, key: [sampler, type], values: [random, jittered]}
"""

ONE = """\
lamp:
  scene: ball
  size: [40, 30]
  samples: 4
  title: A ball
  alt: "A lamp of radius {radius}."
  sliders:
    - {name: radius, key: [lights, 0, radius], values: [0, 0.5, 1.0], unit: world units}
"""

TONES = """\
tones:
  scene: ball
  size: [40, 10]
  samples: 4
  title: A ball
  alt: "A ball of key {key}."
  sliders:
    - {name: key, key: [film, tone, key], values: [0.1, 0.4]}
"""


@pytest.fixture
def scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = tmp_path / "scenes" / "ball.yaml"
    path.parent.mkdir()
    path.write_text(SCENE, encoding="utf-8")
    monkeypatch.setattr(pictures, "scene_path", path.with_stem)
    return path


@pytest.mark.parametrize("name", SERIES)
def test_every_step_is_a_scene(name: str) -> None:
    series = SERIES[name]
    path = PROJECT / "scenes" / f"{series.scene}.yaml"
    seen = set()
    for step in series.steps():
        overrides = series.overrides(step)
        seen.add(f"{overrides} {series.samples_of(step)}")
        samples = {series_file.SAMPLES: series.samples_of(step)}
        scene = load_description(path, {**overrides, **samples}).description
        assert scene.sampler.samples == series.samples_of(step)
        if scene.sampler.type in ("regular", "jittered"):
            assert series.samples_of(step) ** 0.5 % 1 == 0
    assert len(seen) == len(list(series.steps()))


@pytest.mark.parametrize("name", SERIES)
def test_a_series_keeps_the_proportions_of_its_scene(name: str) -> None:
    film = load_description(PROJECT / "scenes" / f"{SERIES[name].scene}.yaml").description.film
    width, height = SERIES[name].size
    assert width / height == pytest.approx(film.width / film.height, rel=1 / height)


@pytest.mark.parametrize("name", SERIES)
def test_every_command_is_one_that_the_program_takes(name: str) -> None:
    for step in SERIES[name].steps():
        _, *words = shlex.split(series_pictures.command(SERIES[name], step))
        command = commands.get_command(click.Context(commands), words[0])
        assert command is not None
        given = command.make_context("render", words[1:]).params
        assert given["spp"] == SERIES[name].samples_of(step)


def test_every_series_is_on_a_page() -> None:
    pages = [path.read_text(encoding="utf-8") for path in (PROJECT / "docs").rglob("*.md")]
    for name in SERIES:
        marks = [f"<!-- site: {kind} {name} -->" for kind in ("series", "series_grid")]
        assert any(mark in page for page in pages for mark in marks), name


def test_words_say_the_values() -> None:
    lamp = series_file.read(ONE)["lamp"]
    assert series_pictures.caption(lamp, (1,)) == "radius: 0.5 world units"
    assert lamp.alternative((1,)) == "A lamp of radius 0.5 world units."
    assert series_pictures.change(lamp, (1,)) == "lights[0].radius: 0.5"
    focus = series_pictures.change(SERIES["focus"], (0,))
    assert focus == "camera.lens.focus_point: [-1.6, 0.61, 1.6]"
    assert series_pictures.caption(SERIES["soft_shadows"], (0, 0)) == (
        "radius: 0 world units, 1 sample"
    )


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("radius, key", "radius, size: 3, key", "size"),
        ("[0, 0.5, 1.0]", "[0]", "length >= 2"),
        ("unit: world units", "labels: [a]", "3 values and 1 labels"),
        ("unit: world units", "start: 3", "start is 3, and there are 3 values"),
        ("{radius}", "some", "alt doesn't say {radius}"),
    ],
)
def test_what_is_wrong_with_the_file_is_named(old: str, new: str, said: str) -> None:
    with pytest.raises(CourseError, match=r"series\.yaml") as caught:
        series_file.read(ONE.replace(old, new))
    assert said in str(caught.value)


def test_an_unknown_series_is_named() -> None:
    with pytest.raises(CourseError, match="no series nonsense; it has supersampling, "):
        series_file.series_named("nonsense")


def test_a_picture_is_the_one_that_its_command_renders(
    scene: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    seen = set()
    for series in (series_file.read(TWO)["ball"], series_file.read(ONE)["lamp"]):
        for step in series.steps():
            kept = series_pictures.picture(series, step, tmp_path / "kept").read_bytes()
            seen.add(kept)
            changed = yaml.safe_load(SCENE)
            if series_pictures.change(series, step):
                assert series_pictures.change(series, step).startswith("lights[0].radius: ")
                changed["lights"][0]["radius"] = series.sliders[0].values[step[0]]
            scene.with_stem("copy").write_text(yaml.safe_dump(changed), encoding="utf-8")
            _, *words = shlex.split(series_pictures.command(series, step))
            done = CliRunner().invoke(commands, words)
            assert done.exit_code == 0, done.output
            encoded = BytesIO()
            Image.open("ball.png").convert("RGB").save(
                encoded, "WEBP", quality=series_pictures.QUALITY
            )
            assert kept == encoded.getvalue(), series_pictures.caption(series, step)
    # One jittered sample is a random one.
    assert len(seen) == 6


@pytest.mark.usefixtures("scene")
def test_a_picture_is_rendered_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lamp = series_file.read(ONE)["lamp"]
    path = series_pictures.picture(lamp, (1,), tmp_path)
    monkeypatch.setattr(series_pictures, "render", None)
    assert series_pictures.picture(lamp, (1,), tmp_path) == path
    with pytest.raises(TypeError):
        series_pictures.picture(lamp, (2,), tmp_path)


def test_steps_of_tone_share_their_rays(
    scene: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    toned = SCENE.replace("height: 300}", "height: 300, tone: {key: 0.2, burn: 1}}")
    scene.write_text(toned, encoding="utf-8")
    series = series_file.read(TONES)["tones"]
    asked: list[int] = []

    def counted(scene: Scene, **settings: Any) -> Picture:
        asked.append(settings["spp"])
        return render(scene, **settings)

    monkeypatch.setattr(series_pictures, "render", counted)
    series_pictures._of_rays.cache_clear()
    for place, key in enumerate((0.1, 0.4)):
        with Image.open(series_pictures.picture(series, (place,), tmp_path / "kept")) as kept:
            shown = kept.convert("RGB").tobytes()
        values: Overrides = {("film", "tone", "key"): key}
        made = render(load_variant(scene, values), size=(40, 10), spp=4, threads=1)
        file = tmp_path / "apart.webp"
        webp.save(webp.on_screen(made), file, series_pictures.QUALITY)
        with Image.open(file) as apart:
            assert shown == apart.convert("RGB").tobytes()
    assert asked == [4, 1, 1]


def test_blank_pictures_differ(tmp_path: Path) -> None:
    shadows = SERIES["soft_shadows"]
    greys = set()
    for step in shadows.steps():
        path = series_pictures.blank(shadows, step, tmp_path / f"{step}.webp")
        with Image.open(path) as image:
            assert image.size == shadows.size
            greys.add(image.convert("RGB").getpixel((7, 7)))
    assert len(greys) == 24


@pytest.fixture
def shadows(browser: Any, site: Path) -> Iterator[Any]:
    """The page with two sliders; nothing may go wrong on it."""
    with untroubled(browser, viewport={"width": 1280, "height": 1000}) as page:
        page.goto((site / "modules" / "soft_shadows.html").as_uri())
        yield page


def _shown(page: Any) -> list[str]:
    return [
        str(image.get_attribute("src")).rpartition("/")[2]
        for image in page.locator("figure.series img").all()
        if image.is_visible()
    ]


def test_sliders_change_the_picture_by_keyboard(shadows: Any) -> None:
    figure = shadows.locator("figure.series")
    assert _shown(shadows) == ["soft_shadows-3-3.webp"]
    tab_to(shadows, "#series-soft_shadows-0")
    before = figure.locator(".frames").screenshot()
    shadows.keyboard.press("ArrowRight")
    assert _shown(shadows) == ["soft_shadows-4-3.webp"]
    assert figure.locator("output").all_text_contents() == ["0.8 world units", "64 samples"]
    assert figure.locator("input").first.get_attribute("aria-valuetext") == "0.8 world units"
    assert "lights[0].radius: 0.8 into" in figure.locator(".same").inner_text()
    assert figure.locator(".frames").screenshot() != before
    shadows.keyboard.press("Tab")
    shadows.keyboard.press("Home")
    assert _shown(shadows) == ["soft_shadows-4-0.webp"]
    assert "--spp 1 -o" in figure.locator(".same").inner_text()
    assert "radius is 0.8 world units, with 1 sample a pixel" in str(
        figure.locator("img:visible").get_attribute("alt")
    )


def test_sliders_have_names(shadows: Any) -> None:
    assert shadows.get_by_role("slider", name="radius", exact=True).count() == 1
    assert shadows.get_by_role("slider", name="samples", exact=True).count() == 1


def test_only_pictures_one_step_away_are_fetched(shadows: Any) -> None:
    fetched = """() => [...document.querySelectorAll("figure.series img")]
        .filter((image) => image.naturalWidth > 0).map((image) => image.src.split("/").pop())"""
    shadows.locator("figure.series").scroll_into_view_if_needed()
    shadows.wait_for_function(f"({fetched})().length >= 1")
    tab_to(shadows, "#series-soft_shadows-0")
    wanted = {f"soft_shadows-{step}.webp" for step in ("3-3", "2-3", "4-3", "3-2")}
    shadows.wait_for_function(f"({fetched})().length >= {len(wanted)}")
    assert set(shadows.evaluate(fetched)) == wanted


def test_without_scripts_all_pictures_have_their_values(browser: Any, site: Path) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((site / "modules" / "soft_shadows.html").as_uri())
    assert len(_shown(page)) == 24
    captions = page.locator("figure.series .frame span").all_inner_texts()
    assert captions[:2] == ["radius: 0 world units, 1 sample", "radius: 0 world units, 4 samples"]
    assert captions[-1] == "radius: 1.6 world units, 64 samples"
    boxes = [page.locator("figure.series img").nth(k).bounding_box() for k in range(5)]
    assert boxes[0]["x"] < boxes[3]["x"]
    assert boxes[0]["y"] == boxes[3]["y"] < boxes[4]["y"]
    assert page.locator("figure.series input").count() == 0
    assert "course render scenes/copy.yaml" in page.locator("figure.series .same").inner_text()
    context.close()
