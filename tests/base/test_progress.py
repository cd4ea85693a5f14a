"""A bar where somebody looks, nothing elsewhere."""

import io
import sys
from time import sleep

import pytest

from course.base import progress


def test_nothing_is_shown_where_there_is_no_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    with progress.progress_bar("box") as report:
        assert report is None
    assert capsys.readouterr() == ("", "")


class Terminal(io.StringIO):
    """What a terminal was shown."""

    def isatty(self) -> bool:
        return True

    def wait_for(self, text: str) -> None:
        """Wait until it shows a text, for a minute at most."""
        for _ in range(6000):
            if text in self.getvalue():
                return
            sleep(0.01)
        pytest.fail(f"{text!r} is not in {self.getvalue()!r}")


def _terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    """A stderr that is a terminal, and a bar that appears at once.

    Not a fixture: pytest gives each test a stderr of its own when its fixtures are there.
    """
    shown = Terminal()
    monkeypatch.setattr(sys, "stderr", shown)
    monkeypatch.setattr(progress, "SHOWN_AFTER", 0.0)
    return shown


def test_a_terminal_shows_a_bar_on_stderr(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    terminal = _terminal(monkeypatch)
    with progress.progress_bar("box") as report:
        assert report is not None
        report(0.5, False)
        terminal.wait_for("box")
        report(1.0, True)
    assert "100%" in terminal.getvalue()
    assert "left" in terminal.getvalue()
    assert not capsys.readouterr().out


def test_a_bar_is_shown_before_the_first_report(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _terminal(monkeypatch)
    with progress.progress_bar("reading a scene"):
        terminal.wait_for("gone")
    assert "reading a scene" in terminal.getvalue()
    assert "left" not in terminal.getvalue()


def test_short_work_shows_no_bar(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "SHOWN_AFTER", 1e9)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with progress.progress_bar("box") as report:
        assert report is not None
        report(1.0, True)
    assert capsys.readouterr() == ("", "")


def test_a_note_stands_beside_the_label(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    terminal = _terminal(monkeypatch)
    with progress.progress_bar("box") as report:
        assert isinstance(report, progress._Bar)
        report.note("not bounded: caustics")
        report(0.5, False)
        terminal.wait_for("box (not bounded: caustics)")
