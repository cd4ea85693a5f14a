"""What attacks may reach for, set up on this machine, and what has become of it after each."""

import contextlib
import hashlib
import json
import os
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from time import monotonic, sleep

from course.engine.functions.effects import PROJECT
from course.school.grading.worker.sandbox import HERE, WORKER_FILES

GONE_WITHIN = 3.0
"""Seconds that what a worker has started may take to end after it."""


class Stage:
    """Files, a process and sockets of the grader's user that no attack may read, change or reach.

    Attributes
    ----------
    token : in every file that is secret
    mark : in the names of what attacks make, and on the command line of every worker
    """

    def __init__(self) -> None:
        self.token = secrets.token_hex(16)
        self.mark = secrets.token_hex(8)
        self._files = contextlib.ExitStack()
        self._victim: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> "Stage":
        # In a folder that only its owner may enter: what a worker with a user of its own relies on.
        self._root = self._folder()
        self._open = self._folder()
        self._open.chmod(0o777)
        self._files.callback(self._end_victim)
        self._place()
        self._tcp = self._listening(socket.AF_INET, socket.SOCK_STREAM, ("127.0.0.1", 0))
        self._udp = self._listening(socket.AF_INET, socket.SOCK_DGRAM, ("127.0.0.1", 0))
        path = f"{self._open}/socket"
        self._unix = self._listening(socket.AF_UNIX, socket.SOCK_STREAM, path)
        Path(path).chmod(0o777)
        self._abstract = self._listening(socket.AF_UNIX, socket.SOCK_STREAM, f"\0{self.mark}")
        self._before = self._state()
        return self

    def __exit__(self, *_: object) -> None:
        self._files.close()

    def described(self) -> str:
        """For the attacks, in JSON."""
        return json.dumps(
            {
                "mark": self.mark,
                "secrets": list(map(str, self._secrets)),
                "secret_folders": [str(self._root), *(str(path.parent) for path in self._secrets)],
                "open": str(self._open),
                "folders": list(map(str, self._folders())),
                "ours": [str(HERE / name) for name in WORKER_FILES],
                "project": str(PROJECT),
                "victim": self._victim.pid,
                "grader": os.getpid(),
                "tcp": self._tcp.getsockname()[1],
                "udp": self._udp.getsockname()[1],
                "socket": self._unix.getsockname(),
                "abstract": self.mark,
            }
        )

    def workers(self) -> frozenset[int]:
        """Processes that bear the mark now."""
        return frozenset(_marked(self.mark))

    def effects(self, working: frozenset[int] = frozenset()) -> list[str]:
        """What is not as it was, in words; all is put back.

        Parameters
        ----------
        working : processes of a worker that goes on
        """
        found = []
        if left := self._left(working):
            found.append(f"{len(left)} processes left behind")
            for number in left:
                with contextlib.suppress(OSError):
                    os.kill(number, signal.SIGKILL)
        for path in self._forged():
            found.append(f"{path} made")
            _remove(path)
        after = self._state()
        if after != self._before:
            names = self._before.keys() | after.keys()
            found += [
                f"{name} changed"
                for name in sorted(names)
                if after.get(name) != self._before.get(name)
            ]
            self._place()
            self._before = self._state()
        for name, listening in (
            ("TCP", self._tcp),
            ("UDP", self._udp),
            ("a Unix socket", self._unix),
            ("an abstract socket", self._abstract),
        ):
            with contextlib.suppress(BlockingIOError):
                if listening.type == socket.SOCK_STREAM:
                    listening.accept()[0].close()
                else:
                    listening.recv(9)
                found.append(f"{name} was reached")
        return found

    def _place(self) -> None:
        """Put secrets and the victim there, as at first."""
        for path in self._root.iterdir():
            shutil.rmtree(path)
        names = ("solutions/motion_blur.txt", "results/grades.txt", "submissions/ada/lens.txt")
        self._secrets = [self._root / name for name in names]
        for path in self._secrets:
            path.parent.mkdir(parents=True)
            path.write_text(f"TOKEN = '{self.token}'\n")
        self._end_victim()
        sleeper = "import time; time.sleep(99999)"
        self._victim = subprocess.Popen(
            [sys.executable, "-c", sleeper, self.token],
            env=os.environ | {"TOKEN": self.token},
            start_new_session=True,
        )

    def _state(self) -> dict[str, object]:
        number = self._victim.pid
        state: dict[str, object] = {"the victim": self._victim.poll()}
        if self._victim.poll() is None:
            state |= {
                "the victim's priority": os.getpriority(os.PRIO_PROCESS, number),
                "the victim's processors": os.sched_getaffinity(number),
                "the victim's scheduling": os.sched_getscheduler(number),
                "the victim's limits": Path(f"/proc/{number}/limits").read_text(),
            }
        ours = [HERE / name for name in WORKER_FILES]
        for path in (*self._root.rglob("*"), *self._secrets, *ours):
            state[str(path)] = _fingerprint(path)
        shared = Path("/proc/sysvipc/shm").read_text().split()
        state["System V shared memory"] = "28769" in shared
        return state

    def _forged(self) -> list[Path]:
        found = [path for folder in self._folders() for path in _matching(folder, f"*{self.mark}*")]
        return [*found, *_matching(self._root, "*-gone"), *_matching(self._root, "*.gone")]

    def _left(self, working: frozenset[int]) -> frozenset[int]:
        """Processes that bear the mark and don't end by themselves at once."""
        deadline = monotonic() + GONE_WITHIN
        while (left := self.workers() - working) and monotonic() < deadline:
            sleep(0.02)
        return left

    def _folders(self) -> list[Path]:
        names = ("/tmp", "/var/tmp", "/dev/shm", "/", "/run", "/worker", "/site")
        return [*map(Path, names), Path.home(), Path.cwd(), self._open, self._root]

    def _folder(self) -> Path:
        path = Path(tempfile.mkdtemp(prefix="attacked-"))
        self._files.callback(shutil.rmtree, path, True)
        return path

    def _end_victim(self) -> None:
        if self._victim is not None:
            self._victim.kill()
            self._victim.wait()

    def _listening(self, family: int, kind: int, address: object) -> socket.socket:
        listening = self._files.enter_context(socket.socket(family, kind))
        listening.bind(address)
        if kind == socket.SOCK_STREAM:
            listening.listen(99)
        listening.setblocking(False)
        return listening


def _fingerprint(path: Path) -> tuple[object, ...]:
    try:
        seen = path.stat()
        content = hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
    except OSError as error:
        return (type(error).__name__,)
    return seen.st_mode, seen.st_uid, seen.st_size, seen.st_mtime_ns, content


def _marked(mark: str) -> Iterator[int]:
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if mark.encode() in path.read_bytes():
                yield int(path.parent.name)
        except OSError:
            continue


def _matching(folder: Path, pattern: str) -> list[Path]:
    try:
        return [*folder.glob(pattern)]
    except OSError:
        return []


def _remove(path: Path) -> None:
    with contextlib.suppress(OSError):
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path, True)
        else:
            path.unlink()
