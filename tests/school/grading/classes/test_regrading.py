"""A class graded again: who changes by which check is told first, and written only then."""

import csv
import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from course.cli.main import commands
from course.school.grading.checks import result as results
from course.school.grading.checks.result import Status
from course.school.grading.classes import grading, regrading
from course.school.grading.classes.engines import Outcome
from course.school.grading.classes.job import Graded, GradingJob, report_files, troubled
from course.school.grading.report import Report

SOURCE = "def displacement(velocity, time):\n    return velocity[:, None] * time\n"


def graded(student: str, points: float) -> Graded:
    """A grader's work of no time: two checks, one of which gives these points."""
    ended = Status.PASSED if points == 2.0 else Status.FAILED
    report = Report(
        student,
        (
            results.Result(
                "motion_blur", "displacement", "a", "A", "property", Status.PASSED, 1, 1
            ),
            results.Result("motion_blur", "displacement", "b", "B", "property", ended, points, 2),
        ),
        seed=20261,
        version=grading.__version__,
    )
    return Graded(report, report_files(report))


class Engine:
    """Gives each student the points that this test says."""

    def __init__(self, **points: float) -> None:
        self.points = points
        self.graded: list[str] = []

    def __call__(self, _: object, items: Sequence[GradingJob], __: object) -> Any:
        for job in items:
            self.graded.append(job.student)
            if job.student not in self.points:
                yield Outcome(job, None, "it broke")
            elif job.trouble:
                report = troubled(job.student, job.trouble, job.settings.seed)
                yield Outcome(job, Graded(report, report_files(report)))
            else:
                yield Outcome(job, graded(job.student, self.points[job.student]))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(grading, "make_references", lambda *a: a[2].write_bytes(b""))
    for student in ("ada", "bob", "cleo"):
        (tmp_path / "class" / student).mkdir(parents=True)
        (tmp_path / "class" / student / "motion_blur.py").write_text(SOURCE)
    return tmp_path / "class"


def run(
    monkeypatch: pytest.MonkeyPatch, engine: Engine, command: str, *arguments: object
) -> Result:
    monkeypatch.setattr("course.cli.classes.ClassOptions.class_engine", lambda _: engine)
    return CliRunner().invoke(commands, [command, *map(str, arguments)])


def grades(out: Path) -> dict[str, str]:
    with (out / "grades.csv").open() as file:
        return {row["student"]: row["points"] for row in csv.DictReader(file)}


def test_first_told_and_then_written(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = folder.parent / "out"
    first = Engine(ada=0.0, bob=2.0, cleo=0.5)
    options = ("--out", out, "--seed", 20261, "--modules", "motion_blur")
    done = run(monkeypatch, first, "grade", folder, *options)
    assert done.exit_code == 0, done.output
    before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}

    second = Engine(ada=2.0, bob=2.0, cleo=0.25)
    told = run(monkeypatch, second, "regrade", folder, "--out", out, "--dry-run")
    assert told.exit_code == 0, told.output
    assert "ada: 1 of 3 points (33.3 %) -> 3 of 3 points (100.0 %)" in told.output
    assert "motion_blur.displacement/b: failed, 0 of 2 -> passed, 2 of 2" in told.output
    assert "displacement/a" not in told.output
    assert "bob:" not in told.output
    assert (
        "2 of 3 submissions would change, by +1.75 points together; nothing was written"
        in told.output
    )
    assert {path: path.read_bytes() for path in before} == before

    # What was looked at is what is written, without grading once more.
    applied = run(monkeypatch, second, "regrade", folder, "--out", out)
    assert applied.exit_code == 0, applied.output
    assert second.graded == ["ada", "bob", "cleo"]
    assert "2 of 3 submissions changed" in applied.output
    assert grades(out) == {"ada": "3", "bob": "3", "cleo": "1.25"}
    assert json.loads((out / "ada" / "results.json").read_text())["points"] == 3
    assert not (out / "instructor" / "regraded").exists()

    # And the next grading finds it.
    third = Engine()
    again = run(monkeypatch, third, "grade", folder, *options)
    assert "0 graded now, 3 kept" in again.output
    assert grades(out)["cleo"] == "1.25"


def test_other_code_of_the_grader_is_another_grading(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = folder.parent / "out"
    points = {"ada": 2.0, "bob": 2.0, "cleo": 2.0}
    run(monkeypatch, Engine(**points), "grade", folder, "--out", out, "--modules", "motion_blur")
    looked = Engine(**points)
    run(monkeypatch, looked, "regrade", folder, "--out", out, "--dry-run")
    monkeypatch.setattr(regrading, "_code", lambda: "changed")
    assert (
        "0 of 3 submissions would change"
        in run(monkeypatch, looked, "regrade", folder, "--out", out, "--dry-run").output
    )
    assert looked.graded == ["ada", "bob", "cleo"] * 2


def test_a_fault_of_the_grader_changes_nobody(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = folder.parent / "out"
    points = {"ada": 0.0, "bob": 0.0, "cleo": 0.0}
    run(monkeypatch, Engine(**points), "grade", folder, "--out", out, "--modules", "motion_blur")
    done = run(monkeypatch, Engine(ada=2.0, cleo=2.0), "regrade", folder, "--out", out)
    assert done.exit_code == 1
    assert "left as they were: bob" in done.output
    assert grades(out) == {"ada": "3", "bob": "1", "cleo": "3"}


def test_a_submission_that_can_no_longer_be_read_and_one_that_is_new(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = folder.parent / "out"
    points = {"ada": 2.0, "bob": 2.0, "cleo": 2.0, "dan": 2.0}
    run(monkeypatch, Engine(**points), "grade", folder, "--out", out, "--modules", "motion_blur")
    (folder / "ada" / "motion_blur.py").unlink()
    (folder / "bob").rename(folder.parent / "elsewhere")
    (folder / "dan").mkdir()
    (folder / "dan" / "motion_blur.py").write_text(SOURCE)
    told = run(monkeypatch, Engine(**points), "regrade", folder, "--out", out, "--dry-run").output
    assert "ada: 3 of 3 points (100.0 %) -> not gradable" in told
    assert "bob: graded before, and there is no submission now" in told
    assert "dan: not graded before -> 3 of 3 points" in told


def test_the_policy_and_the_roster_of_the_grading_before_hold(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = folder.parent / "out"
    policy, roster = folder.parent / "policy.yaml", folder.parent / "roster.csv"
    policy.write_text("total: 30\nstudents: {eve: {add: 1}}\n")
    roster.write_text("Student,ID,SIS Login ID\nAda,1,ada\nDan,2,dan\n")
    points = {"ada": 2.0, "bob": 2.0, "cleo": 0.0}
    terms = ("--policy", policy, "--roster", roster, "--title", "Blur (9)")
    done = run(
        monkeypatch,
        Engine(**points),
        "grade",
        folder,
        "--out",
        out,
        "--modules",
        "motion_blur",
        *terms,
    )
    assert done.exit_code == 0, done.output
    assert "the policy names eve, who has handed in nothing" in done.output
    assert "submissions of nobody in the roster: bob; cleo" in done.output
    assert "in the roster, without a submission: Dan" in done.output
    assert "moodle.csv written" in done.output
    done = run(monkeypatch, Engine(**points | {"ada": 0.5}), "regrade", folder, "--out", out)
    assert done.exit_code == 0, done.output
    with (out / "grades.csv").open() as file:
        rows = {row["student"]: row for row in csv.DictReader(file)}
    assert [rows["ada"][name] for name in ("raw", "adjusted", "final")] == ["15"] * 3
    assert "Ada,1,,ada,,15\n" in (out / "canvas.csv").read_text()
    assert "Blur (9)" in (out / "moodle.csv").read_text()
    # Without a roster no table of an earlier one is left.
    run(monkeypatch, Engine(**points), "grade", folder, "--out", out, "--modules", "motion_blur")
    assert not (out / "canvas.csv").exists()


def test_a_folder_that_nothing_was_graded_into(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder.parent / "out").mkdir()
    done = run(monkeypatch, Engine(), "regrade", folder, "--out", folder.parent / "out")
    assert done.exit_code == 1
    assert "holds no class that was graded" in done.output


def test_a_check_that_is_gone_is_told(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = folder.parent / "out"
    points = {"ada": 2.0, "bob": 2.0, "cleo": 2.0}
    run(monkeypatch, Engine(**points), "grade", folder, "--out", out, "--modules", "motion_blur")

    def shorter(student: str, points: float, make: Any = graded) -> Graded:
        made = make(student, points)
        return replace(made, report=replace(made.report, results=made.report.results[:1]))

    monkeypatch.setattr(f"{__name__}.graded", shorter)
    told = run(monkeypatch, Engine(**points), "regrade", folder, "--out", out, "--dry-run").output
    assert "motion_blur.displacement/b: passed, 2 of 2 -> no such check" in told
