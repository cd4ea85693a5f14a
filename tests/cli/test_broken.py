"""A check that breaks ends neither command, and both say so with their exit code."""

from collections.abc import Callable, Generator, Sequence
from pathlib import Path
from typing import Any

import pytest

from course.cli.options import FAILED
from course.engine.functions.effects import PROJECT
from course.school.grading import grading
from course.school.grading.checks.check import Check, ModuleChecks, Trial
from course.school.grading.classes.engines import Outcome
from tests.cli.conftest import Run

MODULE = "motion_blur"
SECRET = "lines of the check itself"


@pytest.fixture
def mine(tmp_path: Path) -> Path:
    folder = tmp_path / "mine"
    folder.mkdir()
    source = (PROJECT / "solutions" / f"{MODULE}.py").read_bytes()
    (folder / f"{MODULE}.py").write_bytes(source)
    return folder


def checked_by(monkeypatch: pytest.MonkeyPatch, *runs: Callable[[Trial], None]) -> None:
    checks = tuple(
        Check("displacement", f"{number}", "It is right", run) for number, run in enumerate(runs)
    )
    monkeypatch.setattr(grading, "module_checks", lambda name: ModuleChecks(name, checks))


def breaks(_: Trial) -> None:
    raise IndexError(SECRET)


def passes(_: Trial) -> None:
    return


def test_check_ends_with_a_code_of_its_own_though_all_points_are_given(
    run: Run, mine: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    checked_by(monkeypatch, breaks, passes)
    result = run("check", MODULE, "--folder", mine)
    assert result.exit_code == FAILED, result.output
    assert "2 of 2 points" in result.stdout
    assert "[grader error, the check broke]" in result.stdout
    assert SECRET not in result.output
    checked_by(monkeypatch, passes, passes)
    assert run("check", MODULE, "--folder", mine).exit_code == 0


def here(
    function: Callable[[Any, Any], Any], items: Sequence[Any], shared: Any
) -> Generator[Outcome[Any, Any], None, None]:
    """Works in this process."""
    for item in items:
        yield Outcome(item, function(item, shared))


def test_grade_tells_the_instructor_all_of_it(
    run: Run, mine: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    checked_by(monkeypatch, breaks, passes)
    monkeypatch.setattr("course.cli.classes.ClassOptions.class_engine", lambda _: here)
    ada = mine.parent / "class" / "ada"
    ada.parent.mkdir()
    mine.rename(ada)
    result = run("grade", ada.parent, "--out", "out", "--modules", MODULE)
    assert result.exit_code == FAILED, result.output
    assert f"ada: the check {MODULE}.displacement/0 broke, 1 of 1 points given" in result.stderr
    assert SECRET in result.stderr
    grades = Path("out/grades.csv").read_text(encoding="utf-8")
    assert f"{MODULE}.displacement/0" in grades
    for file in Path("out/ada").iterdir():
        assert SECRET.encode() not in file.read_bytes()
