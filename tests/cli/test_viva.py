"""`course viva`: three questions about one student's code, with answers for the instructor."""

from pathlib import Path

import pytest

from course.cli import viva
from course.engine.functions.effects import PROJECT
from tests.cli.conftest import Run

pytestmark = pytest.mark.usefixtures("lent_references")


def test_questions_are_printed_with_answers_and_written_as_a_page(run: Run, tmp_path: Path) -> None:
    student = tmp_path / "Ada"
    student.mkdir()
    text = (PROJECT / "solutions" / "motion_blur.py").read_text(encoding="utf-8")
    (student / "motion_blur.py").write_text(text, encoding="utf-8")
    done = run("viva", student, "--html", "viva.html", "--trust-submissions")
    assert done.exit_code == 0, done.stderr
    assert "1. motion_blur." in done.stdout
    assert "3. motion_blur." in done.stdout
    assert done.stdout.count("  -> ") == 3
    assert "not for the student" in done.stdout
    page = (tmp_path / "viva.html").read_text(encoding="utf-8")
    assert "Questions to Ada" in page
    assert page.count("<details") == 3


def test_what_cannot_be_asked_about_is_refused(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "empty").mkdir()
    refused = run("viva", "empty", "--trust-submissions")
    assert refused.exit_code == 1
    assert "empty: there is no file for a module" in refused.stderr
    (tmp_path / "film.py").write_text("def expose(:\n", encoding="utf-8")
    refused = run("viva", ".", "--modules", "film", "--trust-submissions")
    assert refused.exit_code == 1
    assert "no function is right" in refused.stderr
    monkeypatch.setattr(viva, "PROJECT", tmp_path)
    refused = run("viva", "empty")
    assert "this copy has none" in refused.stderr
