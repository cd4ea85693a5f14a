"""The walls that this machine has, and how to start a grader as root or as another user."""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np

from course.engine.functions.effects import PROJECT
from course.school.grading.worker.sandbox import Sandbox, plain, sandbox

WALLS: dict[str, dict[str, bool]] = {
    "bubblewrap": {},
    "bubblewrap alone": {"landlock": False, "seccomp": False},
    "user": {"bubblewrap": False},
    "user without Landlock": {"bubblewrap": False, "landlock": False},
    "Landlock": {"bubblewrap": False, "user": False},
}
"""Name -> what is used of all that there is. Each lets the audit hook out, which is no wall."""

OPEN = "none"
"""No wall: most attacks do harm there, or they were none. Not for root, who could lose more than a stage."""

NOBODY = 65534


def behind(wall: str, mark: str) -> Sandbox:
    """The sandbox of a wall.

    Raises LookupError: this machine has no such wall.
    ``mark``: stands on the command line of every worker, and of what it forks.
    """
    shut_in = plain() if wall == OPEN else sandbox(**WALLS[wall])
    for name, on in (
        ("bubblewrap", shut_in.own_world),
        ("user", bool(shut_in.becomes)),
        ("Landlock", shut_in.landlock),
    ):
        if wall.startswith(name) and not on:
            raise LookupError(f"{name} doesn't work here: {'; '.join(shut_in.protections)}")
    return replace(shut_in, hooked=False, command=(*shut_in.command, "-X", f"mark={mark}"))


@contextmanager
def python_for(user: str) -> Iterator[list[str]]:
    """The command that starts a Python that every user can run, as one of them, with the course on its path.

    Raises LookupError: there is no way here.
    ``user``: "root", or "another" for one that owns nothing.
    """
    if os.geteuid():
        if user == "root":
            raise LookupError("this isn't root")
        yield [sys.executable]
        return
    become = [] if user == "root" else _become()
    base = Path(sys.base_prefix).resolve()
    program = Path(getattr(sys, "_base_executable", sys.executable)).resolve()
    packages = Path(np.__file__).resolve().parents[1]
    path = ["env", f"PYTHONPATH={packages}:{PROJECT}", "PYTHONDONTWRITEBYTECODE=1"]
    if _runs([*_become(), *path, str(program)]):
        yield [*become, *path, str(program)]
        return
    # Python lies where only root can go, as in root's home: it is shown elsewhere, to these processes alone.
    with tempfile.TemporaryDirectory(prefix="python-", dir="/var/tmp") as shown:
        Path(shown).chmod(0o755)
        mount = 'mount --bind "$1" "$2" && shift 2 && exec "$@"'
        elsewhere = ["unshare", "--mount", "sh", "-c", mount, "sh", str(base), shown]
        command = [*path, f"{shown}/{program.relative_to(base)}"]
        if not _runs([*elsewhere, *_become(), *command]):
            raise LookupError("no other user can run this Python, and it can't be shown to one")
        yield [*elsewhere, *become, *command]


def _become() -> list[str]:
    setpriv = shutil.which("setpriv")
    if setpriv is None:
        raise LookupError("setpriv is missing, which would start a process as another user")
    return [setpriv, f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups"]


def _runs(python: list[str]) -> bool:
    ran = subprocess.run(
        [*python, "-c", "import numpy, course"], check=False, capture_output=True, cwd="/"
    )
    return ran.returncode == 0
