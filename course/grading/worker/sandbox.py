"""How a worker is shut in: what bubblewrap shows it where that is installed, and what is left where it isn't."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Sandbox:
    """How to start a worker.

    Attributes
    ----------
    command : before the worker program's own arguments
    path : where the worker finds ``framing`` and NumPy
    readable : folders that the worker's Python needs to read, as it sees them
    protections : what is on, for reports
    """

    command: tuple[str, ...]
    path: tuple[str, ...]
    readable: tuple[str, ...]
    protections: tuple[str, ...]


_ALWAYS = (
    "separate process without the grader's data",
    "limits on processor time, wall clock, memory and output",
    "no files, processes, network or signals from Python",
)


@lru_cache(maxsize=2)
def sandbox(bubblewrap: bool = True) -> Sandbox:
    """The best that this machine has.

    Parameters
    ----------
    bubblewrap : whether to use it where it works
    """
    bwrap = shutil.which("bwrap") if bubblewrap else None
    if bwrap is not None:
        shut_in = _with_bubblewrap(bwrap)
        try:
            works = subprocess.run(
                [*shut_in.command, "-c", "import numpy"],
                check=False,
                capture_output=True,
                timeout=30,
            )
        except (OSError, subprocess.TimeoutExpired):
            works = None
        if works is not None and b"No module named 'numpy'" in works.stderr:
            return shut_in  # Python ran; NumPy is on no path yet.
    return _without()


def _without() -> Sandbox:
    site = Path(np.__file__).resolve().parents[1]
    python = getattr(sys, "_base_executable", None) or sys.executable
    readable = {
        str(Path(sys.base_prefix).resolve()),
        str(Path(os.__file__).resolve().parent),
        str(site),
    }
    return Sandbox(
        (python, "-I", "-S"),
        (str(HERE), str(site)),
        tuple(sorted(readable)),
        (
            *_ALWAYS,
            "not on: bubblewrap (install it to hide files and network from compiled code too)",
        ),
    )


def _with_bubblewrap(bwrap: str) -> Sandbox:
    plain = _without()
    site = Path(np.__file__).resolve().parents[1]
    base = Path(sys.base_prefix).resolve()
    options = ["--unshare-all", "--die-with-parent", "--new-session", "--clearenv"]
    options += ["--setenv", "OPENBLAS_NUM_THREADS", "1", "--setenv", "PYTHONHASHSEED", "0"]
    for name in ("/usr/lib", "/usr/lib64", "/usr/lib32", "/lib", "/lib64"):
        folder = Path(name)
        if folder.is_symlink():
            options += ["--symlink", str(folder.readlink()), name]
        elif folder.is_dir():
            options += ["--ro-bind", name, name]
    if Path("/etc/ld.so.cache").exists():
        options += ["--ro-bind", "/etc/ld.so.cache", "/etc/ld.so.cache"]
    # Of Python itself its program, its library and nothing else that may lie beside them.
    library = Path(os.__file__).resolve().parent
    python = Path(plain.command[0]).resolve()
    for path in {python, library, *base.glob("lib/libpython*")}:
        options += ["--ro-bind", str(path), str(path)]
    for package in ("numpy", "numpy.libs"):
        if (site / package).is_dir():
            options += ["--ro-bind", str(site / package), f"/site/{package}"]
    for name in ("program.py", "framing.py"):
        options += ["--ro-bind", str(HERE / name), f"/worker/{name}"]
    options += [
        "--proc",
        "/proc",
        "--dev",
        "/dev",
        "--remount-ro",
        "/dev",
        "--remount-ro",
        "/",
        "--chdir",
        "/",
    ]
    return Sandbox(
        (bwrap, *options, str(python), "-I", "-S"),
        ("/worker", "/site"),
        (str(library), "/site", "/usr/lib", "/lib"),
        (
            *_ALWAYS,
            "bubblewrap: no network, no home, no course, nothing writable, no other processes",
        ),
    )


def program(shut_in: Sandbox) -> str:
    """The worker program, as the worker sees it."""
    return f"{shut_in.path[0]}/program.py"
