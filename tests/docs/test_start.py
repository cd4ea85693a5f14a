"""The guide "Start in five minutes", done as it is written: nothing has to be typed that isn't on the page."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from click.testing import CliRunner

from course.cli.main import commands
from course.effects import PROJECT

TEXT = (PROJECT / "docs" / "guides" / "start.md").read_text(encoding="utf-8")
SCENE, LAMP = re.findall(r"```yaml\n(.*?)```", TEXT, re.DOTALL)
LINES = re.findall(r"^ {4}course (.*)$", TEXT, re.MULTILINE)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _run(line: str) -> tuple[int, str]:
    words = shlex.split(line)
    if words[0] == "render":
        # The last of two equal options holds: the pictures are only looked for.
        words += ["--size", "48x32"]
    done = CliRunner().invoke(commands, words, prog_name="course")
    return done.exit_code, done.output


def test_the_guide_can_be_followed(here: Path) -> None:
    path = here / "my_shadow.yaml"
    path.write_text(SCENE, encoding="utf-8")
    hard, soft, noisy, info, check, own = LINES
    assert _run(hard)[0] == 0
    assert (here / "my_shadow.png").is_file()

    point = next(line for line in SCENE.splitlines() if "type: point" in line)
    path.write_text(SCENE.replace(f"{point}\n", LAMP), encoding="utf-8")
    for line, name in ((soft, "soft.png"), (noisy, "noisy.png")):
        code, output = _run(line)
        assert code == 0
        assert "soft_shadows.point_on_sphere" in output
        assert (here / name).is_file()

    assert re.search(r"calls soft_shadows\.point_on_sphere +my_shadow\.yaml:11", _run(info)[1])
    code, output = _run(check)
    assert (code, "to do" in output) == (3, True)
    code, output = _run(own)
    assert code == 1
    assert re.search(r"\w+\.\w+: not written yet", output)


def test_the_two_pictures_differ(here: Path) -> None:
    path = here / "my_shadow.yaml"
    pictures = []
    point = next(line for line in SCENE.splitlines() if "type: point" in line)
    for scene in (SCENE, SCENE.replace(f"{point}\n", LAMP)):
        path.write_text(scene, encoding="utf-8")
        _run(LINES[0])
        pictures.append((here / "my_shadow.png").read_bytes())
    assert pictures[0] != pictures[1]
