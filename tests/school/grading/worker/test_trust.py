"""Grading without walls happens only when somebody asks for it, and then every format says so."""

from collections.abc import Callable, Generator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from course.cli.main import commands
from course.engine.functions.effects import PROJECT
from course.school.grading.classes import grading, job
from course.school.grading.classes.engines import Outcome
from course.school.grading.classes.grading import Runner, grade_class
from course.school.grading.classes.settings import GradingSettings
from course.school.grading.report import UNPROTECTED
from course.school.grading.worker.sandbox import NotProtected, Sandbox, plain

SETTINGS = GradingSettings(0, ("motion_blur",))

pytestmark = pytest.mark.usefixtures("references_at_hand")

COULD_READ = f"{UNPROTECTED}: student code could read solutions, results and other submissions"


def unprotected(*_: object, **__: object) -> Sandbox:
    return replace(plain(), lacks=("read",), protections=(COULD_READ, *plain().protections))


def refused(*_: object, **__: object) -> Sandbox:
    raise NotProtected("on this machine student code could do harm; --trust-submissions")


def here(function: Callable[..., Any], items: Sequence[Any], shared: Any) -> Generator[Any]:
    for item in items:
        yield Outcome(item, function(item, shared))


@pytest.fixture
def submissions(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for module in (grading, job):
        monkeypatch.setattr(module, "protected", refused)
    monkeypatch.setattr(job, "sandbox", unprotected)
    folder = tmp_path / "submissions" / "ada"
    folder.mkdir(parents=True)
    (folder / "motion_blur.py").write_bytes((PROJECT / "solutions" / "motion_blur.py").read_bytes())
    return folder.parent


def test_a_class_is_refused_before_anything_is_graded(submissions: Path, tmp_path: Path) -> None:
    out = tmp_path / "graded"
    arguments = ["grade", str(submissions), "--out", str(out), "--modules", "motion_blur"]
    result = CliRunner().invoke(commands, arguments)
    assert result.exit_code == 1
    assert "--trust-submissions" in result.output
    assert not list(tmp_path.rglob("grades.csv"))


def test_every_format_says_that_nothing_was_protected(submissions: Path, tmp_path: Path) -> None:
    out = tmp_path / "graded"
    grade_class(submissions, out, SETTINGS, Runner(here, trusted=True))
    written = {path.name: path for path in out.rglob("*") if path.is_file()}
    for name in (
        *("grades.csv", "class.html", "report.html", "results.json"),
        *("gradescope.json", "prairielearn.json", "junit.xml"),
    ):
        assert COULD_READ in written[name].read_text("utf-8"), name


def test_tables_for_learning_systems_say_it_in_their_names(
    submissions: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("course.cli.classes.ClassOptions.class_engine", lambda _: here)
    out, roster = tmp_path / "graded", tmp_path / "roster.csv"
    roster.write_text("Name,SIS Login ID\nAda,ada\n")
    arguments = ["grade", submissions, "--out", out, "--modules", "motion_blur"]
    arguments = [*map(str, [*arguments, "--roster", roster])]
    tables = {"canvas.csv", "moodle.csv"}

    def written() -> set[str]:
        return {path.name for path in out.glob("*.csv")} - {"grades.csv"}

    told = CliRunner().invoke(commands, [*arguments, "--trust-submissions"])
    assert f"{COULD_READ} (1 of 1 graded so): no grade is certain" in told.stderr
    assert written() == {f"not_protected_{name}" for name in tables}
    assert "ada" in (out / "not_protected_canvas.csv").read_text()

    for module in (grading, job):
        monkeypatch.setattr(module, "protected", lambda *_: plain())
    told = CliRunner().invoke(commands, arguments)
    assert (told.exit_code, "certain" in told.stderr) == (0, False)
    assert written() == tables


def test_what_was_graded_unprotected_is_graded_again_when_it_can_be(
    submissions: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "graded"
    first = grade_class(submissions, out, SETTINGS, Runner(here, trusted=True))
    again = grade_class(submissions, out, SETTINGS, Runner(here, trusted=True))
    assert (first.graded, again.graded) == (1, 0)
    for module in (grading, job):
        monkeypatch.setattr(module, "protected", lambda *_: plain())
    last = grade_class(submissions, out, SETTINGS, Runner(here))
    assert last.graded == 1
    assert COULD_READ not in (out / "grades.csv").read_text("utf-8")
