"""Commands that do their work again whenever a file is saved."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import Result

from course.cli import watching
from course.effects import PROJECT
from course.errors import CourseError

Run = Callable[..., Result]


class Saves:
    """Stands in the place of a wait: each does the next thing, and after the last it is Ctrl-C."""

    def __init__(self, *steps: Callable[[], None]) -> None:
        self.steps = list(steps)
        self.waits = 0

    def __call__(self, _seconds: float) -> None:
        self.waits += 1
        if not self.steps:
            raise KeyboardInterrupt
        self.steps.pop(0)()


def later(path: Path, text: str) -> None:
    """Save a file, surely at another time than before."""
    path.write_text(text, encoding="utf-8")
    stamp = path.stat().st_mtime_ns + 10**9 * (1 + len(text))
    os.utime(path, ns=(stamp, stamp))


def test_work_is_done_again_when_a_file_changes_comes_or_goes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file, done = tmp_path / "a.py", list[bool]()
    saves = Saves(
        lambda: None, lambda: later(file, "1"), lambda: later(file, "22"), lambda: None, file.unlink
    )
    monkeypatch.setattr(watching.time, "sleep", saves)
    with pytest.raises(KeyboardInterrupt):
        watching.again_and_again(lambda: done.append(file.exists()), lambda: [file])
    assert done == [False, True, True, False]
    assert saves.waits == 6


def test_a_mistake_is_told_and_waited_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "a.py"
    monkeypatch.setattr(watching.time, "sleep", Saves(lambda: later(file, "1")))
    seen: list[int] = []

    def work() -> None:
        seen.append(1)
        raise [CourseError("a mistake"), NotImplementedError("m.f: not written yet")][len(seen) - 1]

    with pytest.raises(KeyboardInterrupt):
        watching.again_and_again(work, lambda: [file])
    errors = capsys.readouterr().err.splitlines()
    assert [line for line in errors if "error" in line] == [
        "error: a mistake",
        "error: m.f: not written yet",
    ]


def test_render_takes_a_function_as_it_was_saved_last(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = PROJECT / "scenes" / "soft_shadows.yaml"
    mine = tmp_path / "assignments" / "soft_shadows.py"
    mine.parent.mkdir()
    body = "def point_on_sphere(center, radius, u):\n    return center[:, None] + {} * u[:1]\n"
    pictures: list[bytes] = []

    def kept(text: str) -> Callable[[], None]:
        def step() -> None:
            pictures.append((tmp_path / "a.png").read_bytes())
            later(mine, text)

        return step

    saves = Saves(
        kept(body.format(0)), kept(body.format(1)), kept("def point_on_sphere(:\n"), kept("")
    )
    monkeypatch.setattr(watching.time, "sleep", saves)
    options = ["--size", "24x16", "--spp", "1", "--effects", "mine", "-o", "a.png", "--watch"]
    result = run("render", scene, *options)
    assert result.exit_code == 130
    assert result.stdout.count("a.png") == 4
    assert "SyntaxError" in result.stderr
    assert len(set(pictures[:3])) == 3
    assert pictures[3] == pictures[2]
