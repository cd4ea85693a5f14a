"""A METU scene is converted into a temporary folder, which goes however the process ends, short of being killed."""

import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from course.cli.metu import temporary_folder
from tests.cli.signalled import END, LISTENING, interrupted, started

if sys.platform == "win32":
    pytest.skip("no signals to send to another process", allow_module_level=True)

SCENE = Path(__file__).parents[2] / "scenes" / "metu" / "showroom.xml"

DEAF = """
import os, time
from course.cli import metu
metu.GRACE = {grace}
with metu.temporary_folder() as folder:
    (folder / "file").touch()
    for number in {numbers}:
        try:
            os.kill(os.getpid(), number)
            time.sleep(60)
        except SystemExit:
            pass
    time.sleep(60)
"""
"""Drops the exceptions of signals that are sent to it."""


@pytest.fixture
def temporary(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where processes put their temporary folders."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setenv("TMPDIR", str(folder))
    return folder


@contextmanager
def rendering(folder: Path, temporary: Path) -> Iterator[subprocess.Popen[str]]:
    """A render of hours, which has its temporary folder."""
    hours = ["--camera", "1", "--spp", "65536", "--threads", "2"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    process = started(folder, "render", str(SCENE), *hours, **quiet)
    try:
        end = time.monotonic() + END
        while not list(temporary.glob("course-*/*.yaml")):
            assert time.monotonic() < end, "it takes too long"
            assert process.poll() is None
            time.sleep(0.02)
        yield process
    finally:
        process.kill()
        process.wait()


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_process_that_is_told_to_end_leaves_no_folder(
    tmp_path: Path, temporary: Path, number: signal.Signals
) -> None:
    with rendering(tmp_path, temporary) as process:
        process.send_signal(number)
        assert process.wait(END) == 128 + number
    assert list(temporary.iterdir()) == []


def test_ctrl_c_leaves_no_folder(tmp_path: Path, temporary: Path) -> None:
    with rendering(tmp_path, temporary) as process:
        assert interrupted(process)[0] == 128 + signal.SIGINT
    assert list(temporary.iterdir()) == []


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize(("grace", "times"), [(0.2, 1), (60.0, 2)])
def test_a_process_that_does_not_end_by_the_exception_ends_at_once(
    temporary: Path, number: signal.Signals, grace: float, times: int
) -> None:
    """In its time, or when told again."""
    code = LISTENING + DEAF.format(grace=grace, numbers=[int(number)] * times)
    ended = subprocess.run([sys.executable, "-c", code], timeout=END - 1, check=False)
    assert ended.returncode == 128 + number
    assert list(temporary.iterdir()) == []


def test_what_is_ignored_stays_ignored() -> None:
    """As the end of a terminal is by a process that nohup has started."""
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with temporary_folder():
            assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)


def test_signals_are_as_before_once_the_folder_is_gone() -> None:
    before = signal.signal(signal.SIGTERM, signal.SIG_DFL)
    try:
        with pytest.raises(SystemExit), temporary_folder() as folder:
            signal.raise_signal(signal.SIGTERM)
        assert not folder.exists()
        assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
        assert signal.getsignal(signal.SIGALRM) is signal.SIG_DFL
        assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)
    finally:
        signal.signal(signal.SIGTERM, before)
