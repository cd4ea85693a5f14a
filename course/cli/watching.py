"""Do something again whenever one of some files is saved."""

import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NoReturn

import click

from course.base.processes import environment_apart

POLL = 0.4
"""Seconds between two looks at the files."""

GRACE = 3.0
"""Seconds that a process may take to end after Ctrl-C."""

SAID = (0, 1, 2)
"""Exit codes of a command that has done its work, or has told why not."""

PROGRAM = """
import signal, sys
signal.signal(signal.SIGINT, signal.SIG_IGN)
import course.engine.render.render
from course.cli.main import main
if sys.stdin.readline():
    signal.signal(signal.SIGINT, signal.default_int_handler)
    main()
"""
"""Ctrl-C ends what is at work; what waits ends with its pipe."""


def times(files: Iterable[Path]) -> list[int]:
    """When each file was saved last [ns]; 0 for one that isn't there."""
    found = []
    for file in files:
        try:
            found.append(file.stat().st_mtime_ns)
        except OSError:
            found.append(0)
    return found


def await_change(files: Callable[[], Iterable[Path]], seen: list[int]) -> None:
    """Wait until the files are no longer as they were ``seen`` by ``times``."""
    click.echo("watching; Ctrl-C ends it", err=True)
    while times(files()) == seen:
        time.sleep(POLL)


def run_again_and_again(arguments: Sequence[str], files: Callable[[], Iterable[Path]]) -> NoReturn:
    """Run a command in another process, and anew whenever a file is saved, until Ctrl-C.

    A save ends the process that is still at it: a student's function may never end, or end its process.
    ``arguments``: of `course`, without what asks to watch
    """
    at_work = prepared = _prepared(arguments)
    try:
        while True:
            seen = times(files())
            at_work, prepared = prepared, _prepared(arguments)
            _begin(at_work)
            while times(files()) == seen and at_work.poll() is None:
                time.sleep(POLL)
            if (code := at_work.poll()) is not None:
                if code not in SAID:
                    click.echo(
                        f"error: the process has ended by itself: exit code {code}", err=True
                    )
                await_change(files, seen)
            _end(at_work)
    finally:
        _end(prepared)
        with suppress(subprocess.TimeoutExpired, KeyboardInterrupt):
            # Ctrl-C has reached it as well, and it may be keeping what there is.
            at_work.wait(GRACE)
        _end(at_work)


def _prepared(arguments: Sequence[str]) -> subprocess.Popen[bytes]:
    """A process that has imported what takes long, and waits."""
    # Without bytecode: what is saved within the second in which it was compiled would be taken for the same.
    return subprocess.Popen(
        [sys.executable, "-B", "-c", PROGRAM, *arguments],
        stdin=subprocess.PIPE,
        env=environment_apart(),
    )


def _begin(process: subprocess.Popen[bytes]) -> None:
    assert process.stdin is not None
    with suppress(OSError), process.stdin:
        process.stdin.write(b"begin\n")


def _end(process: subprocess.Popen[bytes]) -> None:
    process.kill()
    process.wait()
    if process.stdin is not None:
        with suppress(OSError):
            process.stdin.close()
