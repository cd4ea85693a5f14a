"""How a worker is shut in: with bubblewrap where that is installed, by what the kernel offers everybody, or both.

Nothing is taken for granted: each way is tried with ``probe.py`` on the machine, and what code could still do in there
is what is said of it. A hook inside the interpreter is no wall, for the code runs in the interpreter too.
"""

import base64
import itertools
import json
import os
import re
import shutil
import socket
import subprocess
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from course.school.grading.report import UNPROTECTED
from course.school.grading.worker.confine import landlock_version
from course.school.grading.worker.syscalls import filter_program

HERE = Path(__file__).resolve().parent

WORKER_FILES = ("program.py", "framing.py", "confine.py")
"""All of the course that a worker needs."""

COULD = {
    "read": "read solutions, results and other submissions",
    "write": "write or change files",
    "network": "use the network",
    "processes": "send signals to other processes or leave processes behind",
}
"""Guarantee -> what student code could do where it doesn't hold."""

THREADS = 64
"""The most that a worker may have."""

_OF_THE_KERNEL = ("/proc/sys/kernel/core_pattern", "/proc/sysrq-trigger")
"""Files that only root may write, wherever it is."""

_NOBODY = ("--unshare-user", "--uid", "65534", "--gid", "65534")
ISOLATED: tuple[Sequence[str], ...] = (
    (*_NOBODY, "--disable-userns", "--cap-drop", "ALL"),
    (*_NOBODY, "--cap-drop", "ALL"),
    ("--cap-drop", "ALL"),
)
"""Options from what the newest bubblewrap can do down: no capabilities ever, for root keeps them all otherwise."""


class NotProtected(CourseError):  # noqa: N818 - a state of the machine
    """Other people's code can't be kept from doing harm on this machine."""


@dataclass(frozen=True)
class Sandbox:
    """How to start a worker.

    Attributes
    ----------
    command : before the worker program's own arguments
    path : where the worker finds ``framing`` and NumPy
    readable : folders that the worker's Python needs to read, as it sees them
    protections : what is on, for reports
    becomes : who turns into a user of the worker's own: "" nobody, "worker" itself, "command" from its start
    landlock : whether Landlock leaves it ``readable`` alone
    filtered : whether its system calls are filtered
    own_world : whether it has processes, a network and files of its own, which end with it
    users : whether it makes a namespace of users of its own, where nobody else's threads are counted
    threads : how many it may have; 0 where the kernel can't count them for the worker alone
    lacks : guarantees that don't hold, of ``COULD``
    hooked : whether honest students are told by an audit hook what isn't allowed; no wall
    """

    command: tuple[str, ...]
    path: tuple[str, ...]
    readable: tuple[str, ...]
    protections: tuple[str, ...] = ()
    becomes: str = ""
    landlock: bool = False
    filtered: bool = False
    own_world: bool = False
    users: bool = False
    threads: int = 0
    lacks: tuple[str, ...] = ()
    hooked: bool = True

    def starting(self, user: int) -> dict[str, Any]:
        """Arguments of ``subprocess`` beside the command.

        ``user``: of this worker alone
        """
        starts_as = user if self.becomes == "command" else None
        return {
            "env": {"OPENBLAS_NUM_THREADS": "1", "PYTHONHASHSEED": "0"},
            "cwd": "/" if os.name == "posix" else None,
            "user": starts_as,
            "group": starts_as,
            "extra_groups": None if starts_as is None else (),
        }

    def wall(self, user: int) -> dict[str, Any]:
        """The argument of ``confine``.

        ``user``: of this worker alone
        """
        return {
            "uid": user if self.becomes == "worker" else None,
            "users": self.users,
            "threads": self.threads,
            "landlock": self.readable if self.landlock else None,
            "filter": base64.b64encode(filter_program()).decode() if self.filtered else "",
        }


_INSTALLED = ("site-packages", "dist-packages")
"""Folders of Python's library that hold what was installed."""

_ALWAYS = (
    "separate process without the grader's data",
    "limits on processor time, wall clock, memory and output",
)


@lru_cache(maxsize=1)
def plain() -> Sandbox:
    """A process with limits and nothing else: for one's own code, and the quickest to start."""
    site = Path(np.__file__).resolve().parents[1]
    python = getattr(sys, "_base_executable", None) or sys.executable
    # Python knows the names in its library from its start. What is installed there may be the course.
    library = Path(os.__file__).resolve().parent
    readable = {
        *(str(path) for path in library.iterdir() if path.name not in _INSTALLED),
        *(str(site / name) for name in ("numpy", "numpy.libs")),
        *(str(Path(name).resolve()) for name in ("/usr/lib", "/lib", "/lib64")),
        *map(str, Path(sys.base_prefix).resolve().glob("lib/libpython*")),
    }
    return Sandbox(
        (python, "-I", "-S"),
        (str(HERE), str(site)),
        tuple(sorted(readable)),
        (*_ALWAYS, "nothing else: for one's own code"),
    )


@lru_cache(maxsize=16)
def sandbox(
    bubblewrap: bool = True,
    user: bool = True,
    landlock: bool = True,
    seccomp: bool = True,
    secrets: tuple[Path, ...] = (),
) -> Sandbox:
    """The first way on this machine that keeps all guarantees, or else the one that keeps most.

    Parameters
    ----------
    bubblewrap, user, landlock, seccomp : whether to use it where it works
    secrets : files and folders that a worker must not read, besides the solutions
    """
    best: Sandbox | None = None
    for shut_in in _ways(bubblewrap, user, landlock, seccomp):
        found = _found(shut_in, (PROJECT / "solutions", *secrets))
        if found is None:
            continue
        lacks = tuple(name for name in COULD if name in found)
        if best is None or len(lacks) < len(best.lacks):
            threads = 0 if "threads" in found else shut_in.threads
            best = replace(shut_in, lacks=lacks, threads=threads)
        if not lacks:
            break
    best = best or replace(plain(), lacks=tuple(COULD))
    return replace(best, protections=tuple(_told(best)))


def protected(secrets: Iterable[Path] = ()) -> Sandbox:
    """The sandbox for other people's code.

    Raises NotProtected: a guarantee doesn't hold on this machine.
    ``secrets``: files and folders that the code must not read, besides the solutions
    """
    shut_in = sandbox(secrets=tuple(path.resolve() for path in secrets))
    if shut_in.lacks:
        remedy = (
            "install bubblewrap (apt install bubblewrap) and libseccomp (apt install libseccomp2), "
            "or grade in a Linux container as root, with solutions, submissions and results in folders "
            "that only root can read (chmod 700), such as the image of `course bundle docker`"
        )
        raise NotProtected(
            f"on this machine student code could {_and(COULD[name] for name in shut_in.lacks)}: {remedy}; "
            "--trust-submissions grades without that protection, and every report says so"
        )
    return shut_in


def worker_user(number: int) -> int:
    """A user that owns nothing and is no other worker's.

    ``number``: of the worker in this process
    """
    mine = os.getpid() * 64 + number % 64
    try:
        first, _, count = map(int, Path("/proc/self/uid_map").read_text().split()[:3])
    except (OSError, ValueError):
        first, count = 0, 1 << 16
    if first + count > 1 << 31:
        return (1 << 30) + mine % (1 << 29)
    # A container that has 65,536 users: of these the ones that systemd gives to nobody for long.
    return 61184 + mine % 4336


def _ways(bubblewrap: bool, user: bool, landlock: bool, seccomp: bool) -> Iterator[Sandbox]:
    """From the best down."""
    root = user and hasattr(os, "geteuid") and os.geteuid() == 0
    filtered = seccomp and bool(filter_program())
    landlock = landlock and landlock_version() > 0
    bwrap = shutil.which("bwrap") if bubblewrap else None
    if bwrap is not None:
        for becomes, options in itertools.product(["command", ""] if root else [""], ISOLATED):
            yield replace(
                _with_bubblewrap(bwrap, options),
                becomes=becomes,
                landlock=landlock,
                filtered=filtered,
            )
    if sys.platform == "linux":
        for (becomes, users), closed in itertools.product(
            # The threads of root are never counted, whatever namespace it is in.
            [("worker", False)] * root + [("", True)] * (os.geteuid() != 0) + [("", False)],
            [True, False] if landlock else [False],
        ):
            yield replace(
                plain(),
                becomes=becomes,
                users=users,
                threads=THREADS,
                landlock=closed,
                filtered=filtered,
            )


def _with_bubblewrap(bwrap: str, isolated: Sequence[str]) -> Sandbox:
    outside = plain()
    library, site = Path(os.__file__).resolve().parent, Path(np.__file__).resolve().parents[1]
    python = Path(outside.command[0]).resolve()
    shown = {str(path): str(path) for path in (python, library)}
    shown |= {f"/site/{name}": str(site / name) for name in ("numpy", "numpy.libs")}
    shown |= {f"/worker/{name}": str(HERE / name) for name in WORKER_FILES}
    return replace(
        outside,
        command=(bwrap, *_bubblewrap_options(isolated, shown), str(python), "-I", "-S"),
        path=("/worker", "/site"),
        readable=(str(library), "/site", "/usr/lib", "/usr/lib64", "/lib", "/lib64"),
        own_world=True,
        threads=THREADS,
    )


def _bubblewrap_options(isolated: Sequence[str], shown: Mapping[str, str]) -> list[str]:
    """So that a worker sees Python, NumPy and its own files, and nothing else.

    Parameters
    ----------
    isolated : one of ``ISOLATED``
    shown : path inside -> file or folder that is seen there, if it is there
    """
    options = ["--unshare-all", *isolated, "--die-with-parent", "--new-session", "--clearenv"]
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
    for path in Path(sys.base_prefix).resolve().glob("lib/libpython*"):
        options += ["--ro-bind", str(path), str(path)]
    for inside, outside in shown.items():
        if Path(outside).exists():
            options += ["--ro-bind", outside, inside]
    for folder in (Path(os.__file__).resolve().parent / name for name in _INSTALLED):
        if folder.is_dir():
            options += ["--tmpfs", str(folder), "--remount-ro", str(folder)]
    options += ["--proc", "/proc", "--dev", "/dev"]
    # Without the last, root outside could still write what root may in /proc/sys, capabilities or not.
    options += ["--remount-ro", "/dev", "--remount-ro", "/", "--remount-ro", "/proc"]
    return [*options, "--chdir", "/"]


def _found(shut_in: Sandbox, secrets: Sequence[Path]) -> list[str] | None:
    """Guarantees that don't hold in there, "threads" if they aren't bounded; None if a worker can't even start."""
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        listening.listen()
        number = worker_user(63)
        settings = {
            "path": shut_in.path,
            "wall": shut_in.wall(number),
            "secrets": [str(path) for secret in secrets for path in _some_of(secret)],
            "files": [*_OF_THE_KERNEL],
            "folders": ["/tmp", "/var/tmp", "/dev/shm", "/", str(Path.home()), str(Path.cwd())],
            "port": listening.getsockname()[1],
            "grader": os.getpid(),
            "own_world": shut_in.own_world,
        }
        text = (HERE / "probe.py").read_text(encoding="utf-8")
        try:
            run = subprocess.run(
                [*shut_in.command, "-c", text, json.dumps(settings)],
                check=True,
                capture_output=True,
                timeout=30,
                **shut_in.starting(number),
            )
            found: list[str] = json.loads(run.stdout)
        except (OSError, subprocess.SubprocessError, ValueError):
            return None
    return found


def _some_of(path: Path) -> list[Path]:
    """A folder and the first files in it: who may enter a folder need not be able to list it."""
    files = (one for one in path.rglob("*") if one.is_file()) if path.is_dir() else iter(())
    return [path, *itertools.islice(files, 3)]


def _told(shut_in: Sandbox) -> Iterator[str]:
    """The protections that are on or off, in words; what nobody may overlook comes first."""
    if shut_in.lacks:
        yield f"{UNPROTECTED}: student code could {_and(COULD[name] for name in shut_in.lacks)}"
    yield from _ALWAYS
    if shut_in.own_world:
        yield "bubblewrap: no network, no home, no course, nothing writable, no other processes"
    if shut_in.becomes:
        yield "a user of the worker's own, who owns nothing"
    if shut_in.threads:
        yield f"no more than {shut_in.threads} threads"
    if shut_in.landlock:
        yield "Landlock: no files but Python's own"
    if shut_in.filtered:
        yield "seccomp: no writing, no processes, no sockets, no signals"
    off = {
        "bubblewrap": shut_in.own_world,
        "a user of its own": bool(shut_in.becomes),
        "Landlock": shut_in.landlock,
        "seccomp": shut_in.filtered,
        "a limit on threads": bool(shut_in.threads),
    }
    if not all(off.values()):
        yield f"not on: {', '.join(name for name, on in off.items() if not on)}"


def _and(parts: Iterable[str]) -> str:
    return re.sub(r"; ([^;]*)$", r"; and \1", "; ".join(parts))
