"""A bar where somebody looks, nothing elsewhere."""

import sys

import pytest

from course.cli import progress


def test_nothing_is_shown_where_there_is_no_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    with progress.progress_bar("box") as report:
        assert report is None
    assert capsys.readouterr() == ("", "")


def test_a_terminal_shows_a_bar_on_stderr(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 0.0)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with progress.progress_bar("box") as report:
        assert report is not None
        report(0.5, False)
        report(1.0, True)
    shown = capsys.readouterr()
    assert "box" in shown.err
    assert "100%" in shown.err
    assert not shown.out


def test_short_work_shows_no_bar(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "PATIENCE", 1e9)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with progress.progress_bar("box") as report:
        assert report is not None
        report(1.0, True)
    assert capsys.readouterr() == ("", "")
