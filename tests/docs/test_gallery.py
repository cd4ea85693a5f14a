"""What the gallery shows beside scene files, what is kept for it, and a copy that has no site to build."""

import os
import shutil
import subprocess
from functools import partial
from pathlib import Path

import pytest
from PIL import Image

from course.engine.functions.effects import PROJECT
from course.engine.radiosity import radiosity, solving

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

from sitebuild import other_shots, parts, pictures
from sitebuild.place import Place


def _place(folder: Path, blank: bool = True) -> Place:
    return Place("", blank=blank, made=folder, files={})


def test_a_metu_scene_is_shown_by_each_camera(tmp_path: Path) -> None:
    place = _place(tmp_path)
    text = other_shots.metu_shot(place, "metu/showroom", "2 From above")
    assert text.startswith("## From above\n")
    assert "course render scenes/metu/showroom.xml --camera 2 -o showroom-2.png" in text
    assert "```xml\n<?xml" in text
    with Image.open(place.files["_pictures/metu-showroom-2.webp"]) as image:
        assert image.size == (320, 240)
    assert place.files["_scenes/metu-showroom-2.xml"] == PROJECT / "scenes/metu/showroom.xml"
    with pytest.raises(Exception, match="no camera '9'"):
        other_shots.metu_shot(place, "metu/showroom", "9 From nowhere")


def test_a_room_is_lit_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pictures, "KEPT", tmp_path)
    monkeypatch.setattr(other_shots, "PATCHES", 100)
    monkeypatch.setattr(other_shots, "RADIOSITY_SIZE", (48, 48))
    # Fewer patches alone would have as many rays, each patch the more.
    few_rays = partial(solving.gathered, rays=400_000)
    monkeypatch.setattr(radiosity, "gathered", few_rays)
    place = _place(tmp_path, blank=False)
    text = other_shots.radiosity_shot(place, "radiosity", "A room")
    assert "--patches 100 --size 48x48 -o room.png" in text
    assert " patches, " in text
    with Image.open(place.files["_pictures/radiosity-room.webp"]) as image:
        assert image.size == (48, 48)
        assert image.convert("L").getextrema()[1] > 60
    before = sorted(tmp_path.iterdir())
    assert other_shots.radiosity_shot(place, "radiosity", "A room") == text
    assert sorted(tmp_path.iterdir()) == before


def test_all_of_them_are_parts() -> None:
    text = (PROJECT / "docs" / "gallery.md").read_text(encoding="utf-8")
    kinds = {match[1] for match in parts.MARK.finditer(text)}
    assert {"shot", "metu_shot", "radiosity_shot"} == kinds <= parts.PARTS.keys()


@pytest.mark.skipif(shutil.which("make") is None, reason="there is no make on this machine")
def test_a_copy_without_pages_says_so(tmp_path: Path) -> None:
    shutil.copyfile(PROJECT / "Makefile", tmp_path / "Makefile")
    (tmp_path / "pyproject.toml").touch()
    environment = {name: value for name, value in os.environ.items() if "MAKE" not in name}
    command = ["make", "-n", "docs"]
    told = subprocess.run(
        command, cwd=tmp_path, env=environment, check=False, capture_output=True, text=True
    )
    assert told.returncode == 2
    assert "this copy has no docs/" in told.stderr
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "conf.py").touch()
    subprocess.run(command, cwd=tmp_path, env=environment, check=True, capture_output=True)
