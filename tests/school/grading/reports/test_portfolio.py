"""`course portfolio`: pictures by one's own functions, what they have changed, and the noise that they leave."""

import re
import shutil
from base64 import b64decode
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from time import sleep
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from course.base.errors import FunctionError
from course.cli.main import commands
from course.engine.formats.pictures.display import linear_to_srgb8
from course.engine.functions.effects import PROJECT, Effects
from course.engine.render.picture import Picture
from course.engine.render.render import render
from course.engine.scene.scene import Scene, load_scene
from course.school.grading.progress import FunctionProgress
from course.school.grading.reports import portfolio as made
from course.school.grading.reports.drawing import Panel, draw_curve
from course.school.grading.reports.page import render as fill
from course.school.grading.reports.portfolio import Page, Shown, portfolio

SCENE = """\
film: {width: 24, height: 16, filter: box}
camera: {eye: [0, 1, 4], look_at: [0, 0.5, 0], vertical_fov: 40}
materials: {grey: {color: 0.6}}
objects:
  - {shape: quad, material: grey, width: 8, depth: 8}
  - {shape: box, material: grey, size: [1, 1, 1], transform: [{translate: [0, 0.5, 0]}]}
"""
SPHERE = "lights: [{type: sphere, center: [3, 4, 1], radius: 1, intensity: [40, 40, 40]}]\n"
POINT = "lights: [{type: point, position: [3, 4, 1], intensity: [40, 40, 40]}]\n"


def progress(module: str, name: str, state: str) -> FunctionProgress:
    return FunctionProgress(module, name, state, 10.0, 10.0, "", "", "", "", f"{module}.py", 1)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Soft shadows written, thin_lens not, and a small scene of the former with its before."""
    shutil.copy(PROJECT / "solutions" / "soft_shadows.py", tmp_path)
    shutil.copy(PROJECT / "assignments" / "thin_lens.py", tmp_path)
    (tmp_path / "before").mkdir()
    (tmp_path / "soft_shadows.yaml").write_text(SCENE + SPHERE)
    (tmp_path / "before" / "soft_shadows.yaml").write_text(SCENE + POINT)
    return tmp_path


FOUND = [
    [progress("soft_shadows", "point_on_sphere", "right")],
    [progress("thin_lens", "lens_rays", "to do")],
]


def test_only_what_is_begun_is_shown_with_both_pictures_a_curve_and_whose_functions_it_called(
    folder: Path,
) -> None:
    page = portfolio(FOUND, Effects(folder, filled=True), folder, seconds=4).text
    pictures = re.findall(r'src="(data:image/webp;base64,[^"]+)"', page)
    assert len(pictures) == 2
    assert pictures[0] != pictures[1]
    assert "With <code>soft_shadows.point_on_sphere</code>" in page
    assert '<h2 id="thin_lens">' not in page
    assert "Not begun: thin_lens." in page
    assert "<svg" in page
    assert "://" not in page.replace("http://www.w3.org", "")


def test_a_function_that_fails_is_told_and_the_others_go_on(folder: Path) -> None:
    source = (folder / "soft_shadows.py").read_text(encoding="utf-8")
    broken = source.replace("### BEGIN SOLUTION", "raise ValueError('not a <lamp>')")
    (folder / "soft_shadows.py").write_text(broken, encoding="utf-8")
    shutil.copy(folder / "before" / "soft_shadows.yaml", folder / "thin_lens.yaml")
    found = [FOUND[0], [progress("thin_lens", "lens_rays", "wrong")]]
    page = portfolio(found, Effects(folder, filled=True), folder, seconds=4).text
    assert "not a &lt;lamp&gt;" in page
    assert page.count("data:image/webp") == 1
    assert "None of one's own functions is called here" in page


def test_which_line_asks_for_a_function_is_told_once(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    def rendered(*_: object) -> Shown:
        asked = FunctionError("it failed", "film.expose").asked_by("film.yaml:16", ("film", "tone"))
        raise asked.asked_by("film.yaml:16", ("film", "tone"))

    monkeypatch.setattr(made, "_rendered", rendered)
    page = portfolio(FOUND[:1], Effects(folder, filled=True), folder, seconds=4).text
    assert page.count("film.yaml:16: film.tone asks for it") == 1
    assert "1 of 1 function is right" in page


def test_the_warm_up_comes_first(monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    monkeypatch.setattr(made, "_rendered", lambda module, *_: replace(shown(""), module=module))
    found = [FOUND[0], [progress("sampling", "disk_by_polar", "right")]]
    page = portfolio(found, Effects(folder, filled=True), folder, seconds=4).text
    assert page.index('id="sampling"') < page.index('id="soft_shadows"')


def test_the_last_picture_is_by_ones_own_functions_alone_and_before_it_by_none(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    (folder / "gallery").mkdir()
    (folder / "gallery" / "1984.yaml").write_text(SCENE + SPHERE)
    monkeypatch.setattr(
        made, "_rendered", lambda module, *_: replace(shown("data:,"), module=module)
    )
    page = portfolio(FOUND, Effects(folder, filled=True), folder, seconds=8).text
    headings = re.findall('<h2 id="(.+?)">', page)
    assert headings[-1] == "1984"
    last = page.partition('<h2 id="1984">')[2]
    before, after = re.findall(r'src="data:image/webp;base64,([^"]+)"', last)
    assert "With <code>soft_shadows.point_on_sphere</code>" in last
    assert "Nothing is written" in last
    # The lamp is a point as long as its function isn't written: no pixel lies in a penumbra.
    pictures = [np.asarray(Image.open(BytesIO(b64decode(each))), float) for each in (before, after)]
    assert abs(pictures[0] - pictures[1]).max() > 20
    point = render(load_scene(folder / "before" / "soft_shadows.yaml"), spp=64).linear
    hard = Image.fromarray(linear_to_srgb8(np.moveaxis(point, -1, 0)))
    assert abs(np.asarray(hard, float) - pictures[0]).mean() < 4


def test_nobody_who_has_begun_nothing_has_a_last_picture(folder: Path) -> None:
    (folder / "gallery").mkdir()
    (folder / "gallery" / "1984.yaml").write_text(SCENE + SPHERE)
    page = portfolio(FOUND[1:], Effects(folder, filled=True), folder, seconds=1).text
    assert "1984" not in page


def test_addresses_of_large_pictures_are_printed_whole() -> None:
    """Texts of students are cut in their middle; a picture of 90,000 random pixels is longer than any of those."""
    pixels = np.random.default_rng(1).integers(0, 256, (300, 300, 3)).astype(np.uint8)
    address = Panel("", "", pixels=pixels).data_uri()
    page = fill("portfolio.html.jinja", **EMPTY, modules=[shown(address)])
    content = b64decode(page.split("data:image/png;base64,", 1)[1].split('"', 1)[0])
    assert (np.asarray(Image.open(BytesIO(content))) == pixels).all()


def shown(address: str) -> Shown:
    return Shown("thin_lens", (), "", address, (300, 300), "", None, (), "", ())


EMPTY: dict[str, Any] = {"right": 0, "points": 0, "of": 0, "functions": 0, "left": [], "plot": str}
EMPTY |= {"short": [], "samples": 64, "seconds": 60}


class Slow:
    """A stand-in for rendering: a sample of 24 x 16 pixels takes so many seconds, and loops are compiled at first."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, seconds: float, compiling: float = 0.0):
        self._each, self._compiling, self.time = seconds, compiling, 0.0
        monkeypatch.setattr(made, "monotonic", lambda: self.time)
        monkeypatch.setattr(made, "render", self.render)

    def render(self, scene: Scene, **settings: Any) -> Picture:
        compiling, self._compiling = self._compiling, 0.0
        if compiling:
            from numba.core import event

            with event.trigger_event("numba:compile"):
                sleep(compiling)
        self.time += compiling + self._each * settings["spp"]
        return render(scene, **settings)


def test_pictures_that_the_time_was_too_short_for_are_named_on_the_page(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    Slow(monkeypatch, seconds=0.25)
    page = portfolio(FOUND, Effects(folder, filled=True), folder, seconds=8)
    assert page.short == ("soft_shadows",)
    assert 'pictures of <a href="#soft_shadows">soft_shadows</a> have fewer than 64' in page.text
    assert "A larger <code>--time-limit</code> than 8 seconds" in page.text
    captions = re.findall("<figcaption>(.*?)</figcaption>", page.text)
    counts = [
        re.findall(r"(\d+) of 64 samples a pixel: the time ran short", one) for one in captions
    ]
    (shown,) = re.findall(r"<dt>samples a pixel</dt><dd>(\d+)</dd>", page.text)
    assert counts[1] == [shown]
    assert len(counts[0]) == 1


def test_of_scenes_that_place_few_samples_themselves_it_is_said_why(folder: Path) -> None:
    """Pictures of 4 samples a pixel had said nothing."""
    four = "sampler: {type: jittered, samples: 4}\n"
    for name, lamp, more in (("", SPHERE, ""), ("before/", POINT, four)):
        (folder / f"{name}soft_shadows.yaml").write_text(SCENE + lamp + more)
    text = portfolio(FOUND, Effects(folder, filled=True), folder, seconds=8).text
    before, after = re.findall("<figcaption>(.*?)</figcaption>", text)[:2]
    assert "4 samples a pixel: the scene places its samples itself" in before
    assert "places its samples itself" not in after


def test_of_pictures_with_all_samples_nothing_is_said(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    Slow(monkeypatch, seconds=1e-4)
    page = portfolio(FOUND, Effects(folder, filled=True), folder, seconds=8)
    assert page.short == ()
    assert "ran short" not in page.text
    assert "time-limit" not in page.text


def test_the_time_in_which_loops_are_compiled_is_not_taken_from_the_pictures(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    """The whole second would go on it; the pictures need a third of one."""
    pytest.importorskip("numba")
    Slow(monkeypatch, seconds=0.001, compiling=1.0)
    page = portfolio(FOUND, Effects(folder, filled=True), folder, seconds=1)
    assert page.short == ()


def test_what_every_render_takes_whatever_its_samples_is_not_taken_for_samples(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    """A large scene: its stages take two seconds, a render a fifth of one, and 64 samples a pixel one more."""
    (folder / "soft_shadows.yaml").write_text(
        (SCENE + SPHERE).replace("24, height: 16", "400, height: 266")
    )
    now, made_stages = [0.0], [2.0]

    def rendered(_scene: Scene, spp: int, size: tuple[int, int], **_: object) -> SimpleNamespace:
        now[0] += 0.2 + (made_stages.pop() if made_stages else 0.0)
        now[0] += 1e-5 * spp * size[0] * size[1] / 64
        return SimpleNamespace(interrupted=False)

    monkeypatch.setattr(made, "monotonic", lambda: now[0])
    monkeypatch.setattr(made, "render", rendered)
    scene = load_scene(folder / "soft_shadows.yaml", Effects(folder, filled=True))
    assert made._picture(scene, 8.0, made._Clock())[1] == 0
    assert now[0] < 8


def test_the_terminal_names_the_modules_whose_pictures_got_fewer_samples(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    short = Page("<p>", ("glossy", "thin_lens"))
    monkeypatch.setattr(made, "portfolio", lambda *_: short)
    monkeypatch.setattr("course.school.grading.progress.progress", lambda *_: [])
    said = CliRunner().invoke(commands, ["portfolio", "--folder", ".", "--time-limit", "5"])
    assert said.exit_code == 0, said.output
    assert said.stderr.splitlines()[-1] == (
        "pictures of glossy, thin_lens got fewer samples for want of time: "
        "a larger --time-limit than 5 gives them more"
    )


@pytest.mark.parametrize("noise", [0.5, 2.0])
def test_half_of_the_squared_difference_of_two_pictures_is_the_squared_error(
    monkeypatch: pytest.MonkeyPatch, folder: Path, noise: float
) -> None:
    """80,000 numbers with deviation noise / sqrt(n): their root mean square is within 2% in all but 1e-14 of cases."""

    class Noisy:
        def __init__(self, samples: int, seed: int) -> None:
            rng = np.random.default_rng((samples, seed))
            self.interrupted = False
            self.linear = 3 + noise / samples**0.5 * rng.standard_normal((200, 400))

    monkeypatch.setattr(made, "render", lambda _, spp, size, seed: Noisy(spp, seed))  # noqa: ARG005
    scene = load_scene(folder / "soft_shadows.yaml", Effects(folder, filled=True))
    clock = made._Clock()
    points = tuple(made._errors(scene, clock.now() + 60, clock))
    assert [n for n, _ in points] == list(made.COUNTS)
    for n, error in points:
        assert error == pytest.approx(noise / n**0.5, rel=0.02)
    assert made._slope(points) == pytest.approx(0.5, abs=0.01)


def test_ctrl_c_ends_the_page_and_not_a_picture_of_it(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    picture = render(load_scene(folder / "soft_shadows.yaml", Effects(folder, filled=True)))
    monkeypatch.setattr(made, "render", lambda *_, **__: replace(picture, interrupted=True))
    with pytest.raises(KeyboardInterrupt):
        portfolio(FOUND, Effects(folder, filled=True), folder, seconds=4)


def test_modules_share_what_is_left_of_the_time(
    monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    shares: list[float] = []
    now = [0.0]

    def rendered(
        module: str,
        functions: tuple[FunctionProgress, ...],
        _e: object,
        _s: object,
        t: float,
        _c: object,
    ) -> Shown:
        shares.append(t)
        now[0] += 10
        return Shown(module, (), "", "", (0, 0), "", None, (), "none", functions)

    monkeypatch.setattr(made, "monotonic", lambda: now[0])
    monkeypatch.setattr(made, "_rendered", rendered)
    found = [[progress("soft_shadows", "a", "right")]] * 3
    portfolio(found, Effects(folder, filled=True), folder, seconds=60)
    assert shares == [20, 25, 40]


@pytest.mark.parametrize("scale", [1.0, 0.3, 0.017])
def test_an_error_can_be_read_from_the_axis_wherever_it_lies(scale: float) -> None:
    svg = draw_curve(tuple((n, 0.031 * scale * n**-0.6) for n in (1, 4, 16, 64)))
    assert len(set(re.findall(r"ytick_\d+", svg))) >= 3
