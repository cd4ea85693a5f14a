"""The command as a process that is sent signals."""

import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

END = 60.0
"""Seconds in which a busy machine has begun a render, or ended one."""

AGAIN = 10.0
"""Seconds after which somebody presses Ctrl-C again: Python may drop its exception in the midst of an import."""

LISTENING = """
import signal
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGTERM, signal.SIG_DFL)
signal.signal(signal.SIGHUP, signal.SIG_DFL)
"""
"""What a process begins with: whoever runs the tests may ignore some signals, as under nohup, and its children too."""

COMMAND = f"""{LISTENING}
from course.cli.main import main
main()
"""


def started(folder: Path, *arguments: str, **options: Any) -> subprocess.Popen[str]:
    """`course` with these arguments, begun in a folder."""
    command = [sys.executable, "-c", COMMAND, *arguments]
    return subprocess.Popen(command, cwd=folder, text=True, **options)


def interrupted(process: subprocess.Popen[str]) -> tuple[int, str]:
    """Exit code and stderr of a process, where that is a pipe, after Ctrl-C."""
    for seconds in (AGAIN, AGAIN, END):
        process.send_signal(signal.SIGINT)
        try:
            _, said = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            continue
        return process.returncode, said
    raise AssertionError("Ctrl-C does not end it")
