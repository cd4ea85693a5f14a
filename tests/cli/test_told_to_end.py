"""A METU scene is converted into a temporary folder, which goes however the process ends, short of being killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from course.cli.metu import told_to_end

if sys.platform == "win32":
    pytest.skip("no signals to send to another process", allow_module_level=True)

SCENE = Path(__file__).parents[2] / "scenes" / "metu" / "showroom.xml"
START = 60
"""Seconds in which a busy machine has begun to render."""

COMMAND = (
    "import signal\n"
    # Whoever runs the tests may be deaf to some signals, and its children are so too.
    "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
    "signal.signal(signal.SIGTERM, signal.SIG_DFL)\n"
    "signal.signal(signal.SIGHUP, signal.SIG_DFL)\n"
    "from course.cli.main import main\n"
    "main()\n"
)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_process_that_istold_to_end_leaves_no_folder(
    tmp_path: Path, number: signal.Signals
) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    hours = ["--camera", "1", "--spp", "65536", "--threads", "2"]
    process = subprocess.Popen(
        [sys.executable, "-c", COMMAND, "render", str(SCENE), *hours],
        cwd=tmp_path,
        env={**os.environ, "TMPDIR": str(temporary)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        end = time.monotonic() + START
        while not list(temporary.glob("course-*/*.yaml")):
            assert time.monotonic() < end, "it takes too long"
            assert process.poll() is None
            time.sleep(0.02)
        process.send_signal(number)
        assert process.wait(START) == 128 + number
    finally:
        process.kill()
        process.wait()
    assert list(temporary.iterdir()) == []


def test_what_is_ignored_stays_ignored() -> None:
    """As the end of a terminal is by a process that nohup has started."""
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with told_to_end():
            assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
        assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)
