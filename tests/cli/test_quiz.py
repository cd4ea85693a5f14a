"""`course quiz`: questions for learning platforms, in a folder for the instructor."""

import csv
from importlib import import_module
from pathlib import Path
from zipfile import ZipFile

import pytest

from course.cli import quiz
from tests.cli.conftest import Run, files


def test_a_folder_of_all_formats_is_written(run: Run, tmp_path: Path) -> None:
    done = run("quiz", "out", "--modules", "motion_blur", "--held-back")
    assert done.exit_code == 0, done.stderr
    assert "out: 1 question, with answers: not for students" in done.stdout
    out = tmp_path / "out"
    assert files(out) == {
        *("README.md", "measured.csv", "canvas.zip", "qti21.zip", "moodle.xml"),
        "prairielearn",
    }
    with ZipFile(out / "canvas.zip") as pack:
        assert "motion_blur/motion_blur.xml" in pack.namelist()
        assert pack.testzip() is None
    measured = (out / "measured.csv").read_text(encoding="utf-8")
    rows = list(csv.DictReader(measured.splitlines()))
    assert len(rows) == 10  # pairs of four answers and the right picture
    assert all(float(row["ratio"]) >= 2 for row in rows)
    again = run("quiz", "out")
    assert again.exit_code == 1
    assert "not an empty folder" in again.stderr


def test_a_students_copy_has_no_questions(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(quiz, "PROJECT", tmp_path)
    refused = run("quiz", "out")
    assert refused.exit_code == 1
    assert "this copy has none" in refused.stderr
    assert not (tmp_path / "out").exists()


def test_a_module_is_no_folder(run: Run, tmp_path: Path) -> None:
    refused = run("quiz", "film")
    assert refused.exit_code == 1
    assert "course quiz --modules film FOLDER" in refused.stderr
    assert not (tmp_path / "film").exists()


def test_interrupted_it_ends_the_processes_that_draw_before_their_folder_is_removed(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(quiz.DRAWN_BY)
    there: list[bool] = []
    folders: list[Path] = []

    def contents(*_: object, kept: Path, **__: object) -> None:
        folders.append(kept)
        raise KeyboardInterrupt

    monkeypatch.setattr(quiz, "CHECKOUT", False)
    monkeypatch.setattr(import_module("sitebuild.quiz.export"), "contents", contents)
    studio = import_module("sitebuild.mistakes.figures").STUDIO
    monkeypatch.setattr(studio, "close", lambda: there.append(folders[0].is_dir()))
    done = run("quiz", "out", "--modules", "film")
    assert (done.exit_code, done.stderr) == (130, "interrupted\n")
    assert there == [True]
    assert not folders[0].exists()
