"""Heat maps on pages: the ones that the command makes, with the numbers that their colours mean."""

import re
import shlex
from html import unescape
from io import BytesIO
from pathlib import Path

import pytest
from click.testing import CliRunner
from PIL import Image

from course.cli.main import commands
from course.engine.functions.effects import PROJECT

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

from sitebuild import heat_maps, pictures
from sitebuild.place import Place

BALL = """\
title: A ball
camera: {{eye: [0, 1, 4], look_at: [0, 0.5, 0]}}
film: {{width: 48, height: 32{film}}}
sampler: {{samples: 1}}
{more}
materials: {{grey: {{color: 0.7}}}}
lights: [{{type: directional, direction: [-1, -1, -1], irradiance: 2}}]
objects: [{{shape: sphere, material: grey, radius: 0.8, segments: 12}}]
"""

SCENES = {
    "adaptive_sampling": BALL.format(film=", subdivision: {threshold: 0.1, depth: 2}", more=""),
    "bounding_volumes": BALL.format(film="", more="acceleration: {type: hierarchy}"),
}


@pytest.fixture(params=SCENES)
def scene(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The name of a small scene of each kind; the folder is one of its own."""
    name = str(request.param)
    (tmp_path / "scenes").mkdir()
    file = tmp_path / "scenes" / f"{name}.yaml"
    file.write_text(SCENES[name], encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(pictures, "scene_path", file.with_stem)
    monkeypatch.setattr(pictures, "KEPT", tmp_path / "kept")
    real = pictures.picture
    monkeypatch.setattr(pictures, "picture", lambda planned: real(planned, tmp_path / "kept"))
    return name


def _place(folder: Path, *, blank: bool = False) -> Place:
    return Place("", blank=blank, made=folder / "made", files={})


def test_a_heat_map_is_the_one_that_its_command_makes(scene: str, tmp_path: Path) -> None:
    place = _place(tmp_path)
    html = heat_maps.heat_map(place, scene, "Words & more.")
    assert "Words &amp; more." in html
    assert "\n\n" not in html
    command = unescape(re.findall(r"<code>course (.*?)</code>", html)[0])
    done = CliRunner().invoke(commands, shlex.split(command))
    assert done.exit_code == 0, done.output
    encoded = BytesIO()
    Image.open("heat.png").convert("RGB").save(encoded, "WEBP", quality=pictures.QUALITY)
    assert place.files[f"_pictures/{scene}-heat.webp"].read_bytes() == encoded.getvalue()


def test_the_scale_says_the_fewest_and_the_most(scene: str, tmp_path: Path) -> None:
    html = heat_maps.heat_map(_place(tmp_path), scene)
    low, _, high = re.findall(r"<b>(.*?)</b>", html)
    work = heat_maps.counts(scene)
    assert work.shape == (32, 48)
    assert low == str(work.min())
    assert high == f"{work.max()} {heat_maps.COUNTED[scene]}"
    assert work.max() > work.min()
    # Black for the fewest, almost white for the most.
    ramp = re.findall(r"rgb\((\d+) (\d+) (\d+)\)", html)
    assert ramp[0] == ("0", "0", "0")
    assert ramp[-1] == ("255", "255", "230")


def test_a_heat_map_is_made_once(
    scene: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = heat_maps.heat_map(_place(tmp_path), scene)
    monkeypatch.setattr(heat_maps, "counts", None)
    assert heat_maps.heat_map(_place(tmp_path), scene) == first


def test_grey_ones_are_not_worked_out(
    scene: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(heat_maps, "counts", None)
    place = _place(tmp_path, blank=True)
    assert "<b>fewest</b>" in heat_maps.heat_map(place, scene)
    with Image.open(place.files[f"_pictures/{scene}-heat.webp"]) as image:
        assert image.size == (48, 32)


@pytest.mark.parametrize("module", heat_maps.COUNTED)
def test_pages_show_them(module: str, site: Path) -> None:
    text = (site / "modules" / f"{module}.html").read_text(encoding="utf-8")
    shown = re.findall(r'<figure class="before-after">.*?</figure>', text, re.DOTALL)
    assert len(shown) == (1 if module in heat_maps.INSTEAD else 2)
    assert f"{module}-heat.webp" in shown[-1]
    assert (PROJECT / "scenes" / f"{module}.yaml").is_file()
