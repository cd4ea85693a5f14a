"""Commands run in this process, in an empty folder, with a stand-in for the renderer."""

from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import course
from course.cli.main import commands
from tests.cli.stand_in import Engine
from tests.school.grading.lent import lent_references, references_file, usual_references

__all__ = ["lent_references", "references_file", "usual_references"]

Run = Callable[..., Result]


def files(folder: Path) -> set[str]:
    """The names of what is in a folder."""
    return {path.name for path in folder.iterdir()}


@pytest.fixture
def engine(monkeypatch: pytest.MonkeyPatch) -> Engine:
    """The stand-in, in the places where commands find the real ones."""
    stand_in = Engine()
    monkeypatch.setitem(vars(course), "load_scene", stand_in.load_scene)
    monkeypatch.setitem(vars(course), "render", stand_in.render)
    monkeypatch.setattr("course.engine.render.summary.summarize", lambda scene: scene.summary())
    monkeypatch.setattr("course.engine.scene.darkness.why_dark", lambda scene, *_: scene.why_dark)
    monkeypatch.setattr("course.cli.render.check_spared", lambda *_: None)
    return stand_in


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run `course` with these arguments in an empty folder."""
    monkeypatch.chdir(tmp_path)

    def invoke(*arguments: str | Path) -> Result:
        return CliRunner().invoke(commands, [str(argument) for argument in arguments])

    return invoke
