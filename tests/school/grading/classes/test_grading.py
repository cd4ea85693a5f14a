"""A whole class: graded once whatever happens, and nobody's trouble is another's."""

import csv
import json
import os
import signal
import subprocess
import sys
import zipfile
from collections.abc import Generator, Iterator, Sequence
from dataclasses import fields, replace
from functools import partial
from pathlib import Path
from time import monotonic, sleep
from typing import Any

import psutil
import pytest
from click.testing import CliRunner, Result

from course.base.errors import CourseError
from course.cli.classes import ClassOptions
from course.cli.main import commands
from course.engine.functions.modules import COURSE
from course.school.grading.catalog import with_whole
from course.school.grading.checks.result import Status
from course.school.grading.classes import grading
from course.school.grading.classes.bundles import totals
from course.school.grading.classes.engines import Outcome
from course.school.grading.classes.grading import ClassResult, Runner, grade_class
from course.school.grading.classes.job import Graded, GradingJob, grade_job
from course.school.grading.classes.keeping import _record
from course.school.grading.classes.settings import GradingSettings, read_settings
from course.school.grading.known import known

PROJECT = Path(__file__).parents[4]
RIGHT = (PROJECT / "solutions" / "thin_lens.py").read_text("utf-8")
STUB = (PROJECT / "assignments" / "thin_lens.py").read_text("utf-8")
SLOW = "import time\ntime.sleep(20)\n" + STUB
# Every call within its limit, and all of them together longer than anybody waits.
LONG = STUB + "".join(
    f"\ndef {name}(*_):\n    import time\n    time.sleep(6)\n" for name in COURSE["thin_lens"]
)
ENGINE = "course.cli.classes.ClassOptions.class_engine"
WORTH = pytest.approx(totals(["thin_lens"])["thin_lens"])
FILES = {"report.html", "results.json", "gradescope.json", "prairielearn.json", "junit.xml"}


def hand_in(folder: Path, **sources: str) -> Path:
    for student, source in sources.items():
        (folder / student).mkdir(parents=True, exist_ok=True)
        (folder / student / "thin_lens.py").write_text(source)
    return folder


def run(*arguments: object) -> Result:
    return CliRunner().invoke(commands, ["grade", *map(str, arguments), "--modules", "thin_lens"])


def read(out: Path, student: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((out / student / "results.json").read_text())
    return found


def record(out: Path, student: str) -> dict[str, Any]:
    """What the instructor keeps."""
    found: dict[str, Any] = json.loads(_record(out, student).read_text())
    return found


class Here:
    """An engine in this process that remembers whom it has graded."""

    def __init__(self, fault: str = "") -> None:
        self.graded: list[str] = []
        self.fault = fault

    def __call__(
        self, _: object, items: Sequence[GradingJob], shared: Path | bytes
    ) -> Generator[Outcome[GradingJob, Graded], None, None]:
        for job in items:
            if job.student == self.fault:
                yield Outcome(job, None, "it broke")
            else:
                self.graded.append(job.student)
                yield Outcome(job, grade_job(job, shared))


def grade(
    folder: Path, engine: Any, seed: int = 0, modules: Sequence[str] = ("thin_lens",)
) -> ClassResult:
    return grade_class(
        folder, folder.parent / "out", GradingSettings(seed, tuple(modules)), Runner(engine)
    )


def test_a_file_of_which_nothing_can_be_called_is_remarked_on(tmp_path: Path) -> None:
    folder = hand_in(tmp_path / "class", ada=STUB, bob="1 / 0\n", eve="")
    grade(folder, Here())
    with (tmp_path / "out" / "grades.csv").open() as file:
        rows = {row["student"]: row["remarks"] for row in csv.DictReader(file)}
    assert rows["ada"] == ""
    assert rows["bob"].startswith("thin_lens.py can't be imported: ZeroDivisionError")
    assert rows["eve"] == "thin_lens.py is empty"


def test_a_class_from_folders_and_zip_files(tmp_path: Path) -> None:
    wrong = next(one for one in known("thin_lens") if one.name == "circle_twice")
    folder = hand_in(tmp_path / "class", ada=RIGHT, eve=RIGHT, bob=wrong.source)
    with zipfile.ZipFile(folder / "cleo.zip", "w") as archive:
        archive.writestr("work/thin_lens.py", STUB)
    with zipfile.ZipFile(folder / "dan.zip", "w") as archive:
        archive.writestr("../thin_lens.py", STUB)
    out = tmp_path / "out"
    result = run(folder, "--out", out, "--jobs", 2, "--seed", 11)

    assert result.exit_code == 0, result.output
    assert "5 graded now, 0 kept" in result.output
    for student in ("ada", "bob", "cleo", "dan", "eve"):
        assert {path.name for path in (out / student).iterdir()} == FILES
    ada = read(out, "ada")
    assert (ada["score"], ada["seed"], ada["trouble"]) == (1.0, None, "")
    assert record(out, "ada")["seed"] == 11
    # A seed that is not everybody's is in nothing that may be handed out.
    for name in FILES:
        assert "--seed" not in (out / "ada" / name).read_text()
        assert "--seed" not in (out / "bob" / name).read_text()
    assert "course check thin_lens --only" in (out / "bob" / "report.html").read_text()
    assert 0 < read(out, "bob")["score"] < 1
    assert read(out, "cleo")["score"] == 0
    assert "leads out" in read(out, "dan")["trouble"]
    with (out / "grades.csv").open() as file:
        rows = {row["student"]: row for row in csv.DictReader(file)}
    assert [rows[name]["score"] for name in ("ada", "cleo", "dan")] == ["1", "0", ""]
    page = (out / "class.html").read_text()
    assert "ada" in page
    # Two copies, and one that is wrong in a function and else a copy too.
    assert "3 pairs of modules alike" in result.output

    # And from results that were kept.
    grades = (out / "grades.csv").read_bytes()
    for name in ("grades.csv", "class.html"):
        (out / name).unlink()
    again = run(folder, "--out", out, "--jobs", 2, "--seed", 11)
    assert again.exit_code == 0
    assert "0 graded now, 5 kept" in again.output
    assert (out / "grades.csv").read_bytes() == grades
    assert (out / "class.html").exists()


@pytest.mark.usefixtures("references_at_hand")
def test_only_what_has_changed_is_graded_again(tmp_path: Path) -> None:
    folder = hand_in(tmp_path / "class", ada=STUB, bob=STUB, cleo=STUB)
    here = Here()
    grade(folder, here)
    assert here.graded == ["ada", "bob", "cleo"]
    first = read(tmp_path / "out", "ada")

    here.graded.clear()
    hand_in(folder, bob=STUB + "\n# more")
    _record(tmp_path / "out", "cleo").write_text('{"fingerprint": ')
    result = grade(folder, here)
    assert here.graded == ["bob", "cleo"]
    assert read(tmp_path / "out", "ada") == first
    assert result.reports[0].of == WORTH
    assert first["of"] == WORTH
    assert result.graded == 2

    here.graded.clear()
    grade(folder, here, seed=1)
    assert here.graded == ["ada", "bob", "cleo"]
    here.graded.clear()
    grade(folder, here, seed=1, modules=("thin_lens", "film"))
    assert here.graded == ["ada", "bob", "cleo"]


@pytest.mark.usefixtures("references_at_hand")
def test_another_version_grades_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = hand_in(tmp_path / "class", ada=STUB)
    here = Here()
    grade(folder, here)
    monkeypatch.setattr("course.school.grading.classes.keeping.__version__", "9.9")
    grade(folder, here)
    assert here.graded == ["ada", "ada"]
    # A worker of another version than this one grades nobody.
    monkeypatch.setattr(grading, "__version__", "9.9")
    hand_in(folder, ada=STUB + "#")
    assert grade(folder, here).faults == ["ada"]


@pytest.mark.usefixtures("references_at_hand")
def test_a_fault_of_the_grader_is_no_grade(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = hand_in(tmp_path / "class", ada=STUB, bob=STUB)
    grade(folder, Here())
    hand_in(folder, ada=STUB + "#", bob=STUB + "#")
    monkeypatch.setattr(ENGINE, lambda _: Here(fault="bob"))
    out = tmp_path / "out"
    result = run(folder, "--out", out)
    assert result.exit_code == 1
    assert "to be graded again: bob;" in result.output
    assert not (out / "bob" / "results.json").exists()
    assert "it broke" in (out / "bob" / "report.html").read_text()
    assert read(out, "ada")["of"] == WORTH
    assert "bob,,," in (out / "grades.csv").read_text()

    here = Here()
    monkeypatch.setattr(ENGINE, lambda _: here)
    assert run(folder, "--out", out).exit_code == 0
    assert here.graded == ["bob"]


@pytest.mark.usefixtures("references_at_hand")
def test_the_seconds_of_a_submission_are_an_option(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, out, here = hand_in(tmp_path / "class", ada=RIGHT), tmp_path / "out", Here()
    monkeypatch.setattr(ENGINE, lambda _: here)
    for text in ("1e-9", "1e-9", "2e-9"):
        assert run(folder, "--out", out, "--submission-seconds", text).exit_code == 0
    # Other seconds may give other results.
    assert here.graded == ["ada", "ada"]
    results = read(out, "ada")["results"]
    assert {result["status"] for result in results} == {Status.TIMEOUT}
    assert "the submission's 2e-09 s are over" in results[0]["found"]

    again = ["regrade", str(folder), "--out", str(out)]
    assert CliRunner().invoke(commands, again).exit_code == 0
    assert read(out, "ada")["points"] == 0
    assert CliRunner().invoke(commands, [*again, "--submission-seconds", "1e3"]).exit_code == 0
    assert read(out, "ada")["points"] == WORTH
    assert read_settings(out).submission_seconds == 1e3
    refused = run(folder, "--out", out, "--submission-seconds", "0")
    assert (refused.exit_code, "a number of seconds > 0" in refused.output) == (2, True)


@pytest.mark.usefixtures("references_at_hand")
def test_a_check_with_an_error_of_its_own_is_run_again(tmp_path: Path) -> None:
    folder = hand_in(tmp_path / "class", ada=STUB)

    def doubtful(
        _: object, items: Sequence[GradingJob], shared: Path | bytes
    ) -> Generator[Outcome[GradingJob, Graded], None, None]:
        for job in items:
            graded = grade_job(job, shared)
            first, *rest = graded.report.results
            first = replace(first, status=Status.GRADER_ERROR)
            report = replace(graded.report, results=(first, *rest))
            yield Outcome(job, replace(graded, report=report))

    assert grade(folder, doubtful).doubtful == ["ada"]
    assert read(tmp_path / "out", "ada")["of"] == WORTH
    here = Here()
    assert not grade(folder, here).doubtful
    assert here.graded == ["ada"]


def test_the_last_check_is_for_all_modules_together() -> None:
    assert with_whole(("thin_lens",)) == ("thin_lens",)
    assert with_whole(tuple(COURSE)) == (*COURSE, "whole")


def test_results_may_not_lie_among_submissions(tmp_path: Path) -> None:
    folder = hand_in(tmp_path / "class", ada=STUB)
    for out in (folder, folder / "out"):
        with pytest.raises(CourseError, match="choose a folder elsewhere"):
            grade_class(folder, out, GradingSettings(0, ("thin_lens",)), Runner(Here()))


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--engine", "dask"], "go together"),
        (["--address", "tcp://127.0.0.1:1"], "go together"),
        (["--modules", "bokeh"], "the modules are"),
        (["--engine", "dask", "--address", "tcp://127.0.0.1:1", "--jobs", "2"], "--jobs is for"),
    ],
)
def test_wrong_usage(tmp_path: Path, arguments: list[str], told: str) -> None:
    result = run(hand_in(tmp_path / "class", ada=STUB), "--out", tmp_path / "out", *arguments)
    assert result.exit_code == 2
    assert told in result.output


def start(folder: Path, out: Path, *arguments: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "course", "grade", str(folder), "--out", str(out), *arguments]
    return subprocess.Popen(
        [*command, "--modules", "thin_lens"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        cwd=PROJECT,
    )


def wait_for(what: Any, seconds: float = 30) -> Any:
    deadline = monotonic() + seconds
    while monotonic() < deadline:
        if found := what():
            return found
        sleep(0.05)
    raise AssertionError("nothing came of it")


def workers(process: subprocess.Popen[str]) -> list[psutil.Process]:
    """Processes in which students' code runs."""
    found = []
    for child in psutil.Process(process.pid).children(recursive=True):
        try:
            if any(part.endswith("program.py") for part in child.cmdline()):
                found.append(child)
        except psutil.Error:
            continue
    return found


def pools(process: subprocess.Popen[str]) -> Iterator[psutil.Process]:
    """Processes of the grader's pool that have a worker under way; the grader itself tries the sandbox in one, too."""
    for worker in workers(process):
        try:
            for parent in worker.parents():
                if "spawn_main" in " ".join(parent.cmdline()):
                    yield parent
        except psutil.Error:
            continue


@pytest.mark.usefixtures("references_at_hand")
def test_an_interruption_is_quick_and_keeps_what_is_done(tmp_path: Path) -> None:
    folder = hand_in(tmp_path / "class", ada=STUB, bob=LONG, cleo=LONG)
    out = tmp_path / "out"
    process = start(folder, out, "--jobs", "2")
    wait_for(_record(out, "ada").exists)
    students = wait_for(lambda: workers(process))
    # As a terminal does: to all of them.
    os.killpg(process.pid, signal.SIGINT)
    # Far less than what was left to do.
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "1 of 3 submissions graded and kept; the same command goes on" in errors
    assert "Traceback" not in errors
    wait_for(lambda: not any(student.is_running() for student in students))
    assert not (out / "bob" / "results.json").exists()

    kept = (out / "ada" / "results.json").read_bytes()
    here = Here()
    hand_in(folder, bob=STUB)
    (folder / "cleo" / "thin_lens.py").unlink()
    assert grade(folder, here).graded == 2
    assert here.graded == ["bob", "cleo"]
    assert (out / "ada" / "results.json").read_bytes() == kept


def test_a_process_that_is_killed_costs_nobody_a_grade(tmp_path: Path) -> None:
    slow = SLOW.replace("sleep(20)", "sleep(1)")
    folder = hand_in(tmp_path / "class", ada=slow, bob=STUB, cleo=STUB)
    out = tmp_path / "out"
    process = start(folder, out, "--jobs", "2")
    pool = wait_for(lambda: next(pools(process), None))
    pool.kill()
    output, errors = process.communicate(timeout=50)
    assert process.returncode == 0, errors
    assert "3 graded now" in output
    assert all(read(out, name)["of"] == WORTH for name in ("ada", "bob", "cleo"))


def test_the_engine_of_the_command_line_has_a_process_for_each_core() -> None:
    given = dict.fromkeys(field.name for field in fields(ClassOptions))
    engine = ClassOptions(**given).class_engine()
    assert isinstance(engine, partial)
    assert engine.keywords == {"jobs": os.cpu_count()}
