"""The page of a pixel's rays: small, whole, and for everybody."""

import itertools
from base64 import b64decode
from dataclasses import replace
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import Story, pixel
from course.cli.main import commands
from course.engine.core.types import Floats64
from course.engine.functions.effects import PROJECT
from course.engine.recording import scenery, view
from course.engine.recording.inline import still
from course.engine.recording.pair import pair_data
from course.engine.recording.view import page, rays_data, view_data
from tests.browser import untroubled

CliRunner = pytest.importorskip("click.testing").CliRunner

SCENES = PROJECT / "scenes"


@pytest.fixture(scope="module")
def story() -> Story:
    return pixel(SCENES / "soft_shadows.yaml", 30, 30, spp=64, size=(64, 48))


@pytest.mark.parametrize("name", ["soft_shadows", "path_tracing", "blurred_transparency"])
def test_200_paths_are_less_than_a_megabyte(name: str) -> None:
    told = pixel(SCENES / f"{name}.yaml", 25, 30, spp=256, size=(64, 48))
    data = view_data(told)
    assert len(data["samples"]) == view.MOST_PATHS
    assert data["all"] == 256
    assert len(page(told).encode()) < 1e6


@pytest.mark.parametrize(("balls", "segments"), [(150, 64), (600, 8)])
def test_a_scene_of_many_objects_is_less_than_a_megabyte_too(
    tmp_path: Path, balls: int, segments: int
) -> None:
    """Skittles of 2 MB each would be 300 MB; of too many the largest are shown, though each of them is small."""
    scene = tmp_path / "many.yaml"
    rows = "".join(
        f"  - {{shape: sphere, material: grey, radius: {0.02 + 0.0001 * n}, segments: {segments},"
        f" transform: [{{translate: [{n % 30 - 15}, {n // 30}, 0]}}]}}\n"
        for n in range(balls)
    )
    scene.write_text(
        "camera: {eye: [0, 5, 40], look_at: [0, 5, 0]}\nfilm: {width: 60, height: 40}\n"
        "materials: {grey: {color: 0.7}}\nlights: [{type: point, position: [0, 9, 9], intensity: 90}]\n"
        "objects:\n  - {shape: quad, material: grey, width: 90, depth: 90}\n" + rows,
        encoding="utf-8",
    )
    told = pixel(scene, 30, 30, spp=256)
    shown = view_data(told)["objects"]
    assert len(page(told).encode()) < 1e6
    assert shown[0]["name"] == "quad"
    if balls == 150:
        assert len(shown) == balls + 1
    else:
        # Boxes of the largest, which are the last.
        assert 400 < len(shown) < balls
        assert f"objects.{balls}" in shown[-1]["name"]
        assert "objects.1)" not in str([each["name"] for each in shown])


def test_every_segment_of_what_is_shown_is_there_in_place(story: Story) -> None:
    rows = view_data(story)["segments"]
    assert len(rows) == len(story.segments)
    for row, one in zip(rows, story.segments, strict=True):
        sample, parent, depth, kind, start, end, *_ = row
        assert (sample, depth, view.KINDS[kind]) == (one.sample, one.depth, one.kind)
        assert parent == (-1 if one.parent is None else one.parent)
        np.testing.assert_allclose((start, end), (one.start, one.end), rtol=1e-4, atol=1e-9)


def test_coarser_triangles_fill_the_same_box() -> None:
    numbers = np.random.default_rng(5)
    way: Floats64 = numbers.normal(size=(3000, 1, 3))
    way = way / np.linalg.norm(way, axis=2, keepdims=True)
    ball = way + numbers.normal(scale=0.01, size=(3000, 3, 3))
    coarse = scenery._coarser(ball)
    assert 12 <= len(coarse) <= scenery.MOST_TRIANGLES
    for bound in (np.min, np.max):
        np.testing.assert_allclose(bound(coarse, (0, 1)), bound(ball, (0, 1)), atol=0.3)
    dust = numbers.random((3000, 1, 3)) + np.zeros((3000, 3, 3))
    assert len(scenery._coarser(dust)) == 12


def test_cut_triangles_have_the_same_area() -> None:
    corners = np.array([[[0, 0, 0], [2, 0, 0], [0, 1, 0]]], np.float64)
    pieces = scenery._cut(corners)
    edges = pieces[:, 1:] - pieces[:, :1]
    assert len(pieces) > 1
    areas = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) / 2
    assert areas.sum() == pytest.approx(1)
    assert np.linalg.norm(edges, axis=2).max() <= 2 * scenery.LARGEST_PIECE


def test_names_are_text(story: Story, tmp_path: Path) -> None:
    named = replace(story.recording.scene.loaded, path=tmp_path / "</script><b>[[data]].yaml")
    recording = replace(story.recording, scene=replace(story.recording.scene, loaded=named))
    text = page(Story(recording))
    assert "<b>" not in text
    assert text.count("</script>") == 2
    assert "script&gt;&lt;b&gt;[[data]].yaml" in text


def test_what_is_not_a_number_is_told_as_text(story: Story) -> None:
    radiance = story.recording.radiance.copy()
    radiance[:, 0, 3] = np.nan
    told = Story(replace(story.recording, radiance=radiance))
    assert view_data(told)["samples"][3]["radiance"] == ["nan"] * 3
    assert page(told)


def test_the_command_writes_the_page(tmp_path: Path) -> None:
    scene, out = SCENES / "soft_shadows.yaml", tmp_path / "rays.html"
    arguments = ["pixel", str(scene), "30,30", "--spp", "4", "--size", "64x48", "--html"]
    assert CliRunner().invoke(commands, [*arguments, str(out)]).exit_code == 0
    assert "penumbra.rays(" in out.read_text(encoding="utf-8")
    refused = CliRunner().invoke(commands, [*arguments, str(tmp_path / "no" / "rays.html")])
    assert refused.exit_code == 1


def test_a_notebook_shows_the_view(story: Story) -> None:
    shown = story._repr_html_()
    framed, _, beside = shown.partition("srcdoc='")[2].partition("</iframe>")
    frame, inside = framed.rsplit("'>", 1)
    assert "'" not in frame
    assert unescape(frame) == page(story)
    # Jupyter takes the frame away, and leaves what stands in it and beside it, where a notebook isn't trusted.
    data = beside.partition("data:image/png;base64,")[2].partition('"')[0]
    assert b64decode(data) == still(story)
    assert "<" not in inside
    assert story.tree.text in unescape(inside)
    assert story.reason in unescape(inside)


def test_at_a_prompt_a_story_is_a_line(story: Story) -> None:
    # Notebooks keep it, too, beside the view.
    assert repr(story) == f"<Story of {story.tree.text}; {story.reason}>"
    assert repr(story).startswith("<Story of pixel 30,30 of soft_shadows.yaml: ")


@pytest.fixture
def opened(browser: Any, story: Story, tmp_path: Path) -> Any:
    """The page in a browser without a network; what it complains of is an error."""
    file = tmp_path / "rays.html"
    file.write_text(page(story), encoding="utf-8")
    context = browser.new_context(offline=True, viewport={"width": 1200, "height": 900})
    tab = context.new_page()
    said: list[str] = []
    tab.on("pageerror", lambda error: said.append(str(error)))
    tab.on(
        "console", lambda message: said.append(message.text) if message.type == "error" else None
    )
    tab.goto(file.as_uri())
    _settle(tab)
    yield tab
    assert said == []
    context.close()


def _settle(tab: Any) -> None:
    """Wait until what was asked for is drawn."""
    tab.evaluate("() => new Promise((d) => requestAnimationFrame(() => requestAnimationFrame(d)))")


def _picture(tab: Any) -> str:
    _settle(tab)
    shown: str = tab.evaluate("document.querySelector('.rays canvas').toDataURL()")
    return shown


BLACK = """() => {
  const canvas = document.querySelector(".rays canvas");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let k = 0; k < data.length; k += 4) count += data[k] + data[k + 1] + data[k + 2] < 30 && data[k + 3] > 250;
  return count;
}"""


def test_the_keyboard_does_everything(opened: Any) -> None:
    opened.focus(".rays canvas")
    pictures = [_picture(opened)]
    for key in ("ArrowLeft", "ArrowUp", "+", "."):
        opened.keyboard.press(key)
        pictures.append(_picture(opened))
    assert len(set(pictures)) == len(pictures)
    assert opened.locator("circle.sample.chosen").count() == 1
    assert "Sample 0:" in opened.inner_text(".told")
    assert "soft_shadows.point_on_sphere returned (" in opened.inner_text(".told")
    opened.keyboard.press("Escape")
    assert opened.locator("circle.sample.chosen").count() == 0
    opened.keyboard.press("Home")
    assert _picture(opened) == pictures[0]


def test_kinds_can_be_hidden_and_dots_chosen(opened: Any) -> None:
    whole = _picture(opened)
    opened.uncheck("input[data-kind=shadow]")
    hidden = _picture(opened)
    opened.uncheck("input[data-kind=camera]")
    assert len({whole, hidden, _picture(opened)}) == 3
    opened.check("input[data-kind=shadow]")
    opened.check("input[data-kind=camera]")
    assert _picture(opened) == whole
    opened.locator(".rays circle.sample").nth(7).click()
    assert "Sample 7:" in opened.inner_text(".told")
    assert opened.locator(".rays input[type=range]").last.input_value() == "8"


def test_a_ray_is_black_behind_its_blocker(opened: Any, story: Story) -> None:
    blocked = {one.sample for one in story.segments if one.blocked}
    free = {one.sample for one in story.segments if one.light and not one.blocked} - blocked
    assert blocked
    assert free
    # Without the other rays, which are faint, but many.
    pick = "n => { view.pick(n); view.shown.kinds[0] = false; }"
    opened.evaluate(
        "() => { const root = document.querySelector('.rays');"
        " const data = JSON.parse(root.querySelector('script').textContent);"
        " root.replaceChildren(); window.view = penumbra.rays(root, data); }"
    )
    found = {}
    for name, sample in (("blocked", min(blocked)), ("free", min(free))):
        opened.evaluate(pick, sample)
        opened.evaluate("view.draw()")
        _settle(opened)
        found[name] = opened.evaluate(BLACK)
    assert found["blocked"] > found["free"] + 50


SIZE_OF_VIEW = """data => {
  const root = document.querySelector('.rays');
  root.replaceChildren();
  return penumbra.rays(root, data).view.distance;
}"""


@pytest.mark.parametrize("missing", ["right", "both", "everything"])
def test_rays_that_hit_nothing_leave_a_view_of_what_is_there(
    opened: Any, story: Story, missing: str
) -> None:
    data = pair_data(story, rays_data(story), "")
    usual = opened.evaluate(SIZE_OF_VIEW, data)
    sides = [data["right"]] if missing == "right" else [data, data["right"]]
    for side in sides:
        side["names"] = ["environment"]
        camera = [row for row in side["segments"] if view.KINDS[row[3]] == "camera"]
        side["segments"] = [[*row[:6], 0, *row[7:]] for row in camera]
    if missing == "everything":
        data["objects"], data["lamps"] = [], []
        assert opened.evaluate(SIZE_OF_VIEW, data) > 1e-3 * usual
        return
    size = opened.evaluate(SIZE_OF_VIEW, data)
    assert 0.2 * usual < size < 5 * usual
    opened.locator(".rays input[data-kind=camera]").uncheck()
    _settle(opened)
    painted = opened.evaluate(
        """() => {
          const canvas = document.querySelector(".rays canvas");
          const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
          return data.filter((x, k) => k % 4 === 3 && x > 250).length / (canvas.width * canvas.height);
        }"""
    )
    assert painted > 0.05


def test_depths_are_stepped_through_and_a_dot_lights_its_ray(browser: Any, tmp_path: Path) -> None:
    file = tmp_path / "rays.html"
    file.write_text(page(pixel(SCENES / "glossy.yaml", 540, 408, spp=8)), encoding="utf-8")
    with untroubled(browser, viewport={"width": 1200, "height": 900}) as tab:
        tab.goto(file.as_uri())
        depth = tab.locator("label", has_text="Bounces shown:").locator("input")
        assert depth.get_attribute("max") != "0"
        whole = _picture(tab)
        depth.focus()
        tab.keyboard.press("Home")
        camera = _picture(tab)
        tab.keyboard.press("ArrowRight")
        first = _picture(tab)
        assert camera not in (whole, first)
        lit = []
        for number in (2, 5):
            tab.locator(".rays circle.sample").nth(number).click()
            assert tab.locator("circle.sample.chosen").count() == 1
            assert f"Sample {number}:" in tab.inner_text(".told")
            lit.append(_picture(tab))
        assert len({first, *lit}) == 3


def test_a_click_on_a_ray_chooses_its_sample(opened: Any) -> None:
    box = opened.locator(".rays canvas").bounding_box()
    # Down through the picture: somewhere the rays are crossed.
    for down, across in itertools.product((45, 55, 65), range(4, 100, 4)):
        place = box["x"] + box["width"] * across / 100, box["y"] + box["height"] * down / 100
        opened.mouse.click(*place)
        if opened.locator("circle.sample.chosen").count():
            break
    assert opened.locator("circle.sample.chosen").count() == 1


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_on_a_telephone(opened: Any, scheme: str) -> None:
    accessibility = pytest.importorskip("tests.docs.test_accessibility")
    opened.emulate_media(color_scheme=scheme)
    opened.set_viewport_size({"width": 390, "height": 844})
    opened.locator(".rays circle.sample").nth(1).click()
    assert opened.evaluate("document.documentElement.scrollWidth") <= 390
    for rules in (accessibility.RULES, accessibility.COLOURS):
        assert accessibility._faults(opened, rules) == []


def test_many_numbers_are_rounded_as_single_ones() -> None:
    numbers = np.random.default_rng(3)
    scales: Floats64 = 10.0 ** numbers.integers(-9, 12, (200, 9))
    rows = numbers.normal(size=(200, 9)) * scales
    rows[0, 0] = 0
    found = np.array(scenery._rounded_rows(rows))
    wanted = np.array([scenery.rounded(row) for row in rows], np.float64)
    np.testing.assert_allclose(found, wanted, rtol=2e-5)
    assert max(len(repr(x)) for x in found.ravel().tolist()) <= 15


def test_another_scene_has_its_own_objects(story: Story) -> None:
    first = view_data(story)["objects"]
    other = pixel(SCENES / "cornell_box.yaml", 30, 30, spp=1, size=(64, 48))
    assert view_data(other)["objects"] != first
    assert view_data(story)["objects"] == first
