"""A worker's process and the pipes to it: messages that cross before a deadline, or the reason why they don't."""

import contextlib
import itertools
import json
import os
import select
import signal
import subprocess
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

from course.school.grading.errors import StudentError
from course.school.grading.worker.clock import Clock, Used
from course.school.grading.worker.framing import BrokenMessage, unpack
from course.school.grading.worker.limits import Limits, WorkerBudget
from course.school.grading.worker.sandbox import Sandbox, worker_user

_STARTER = ThreadPoolExecutor(1, thread_name_prefix="starts-workers")
"""All workers are started from one thread that lives as long as this process: a sandbox dies with the *thread* that
started it, and threads that render come and go."""

_NUMBERS = itertools.count()
"""Of workers that this process starts: each has a user of its own."""

SHOWN = 4000
"""Characters of what a student prints that are kept."""

MOST_PRINTED = 1 << 26
"""Bytes that one process may print: to read more would keep the grader itself busy."""


class Process:
    """A process that can be started again when it has ended, and is ended by what goes wrong.

    Parameters
    ----------
    shut_in : how it is started
    limits : what it may use
    budget : what it shares with the other workers of a submission
    """

    def __init__(self, shut_in: Sandbox, limits: Limits, budget: WorkerBudget) -> None:
        self._sandbox = shut_in
        self._limits = limits
        self._budget = budget
        self._guard = threading.Lock()
        self._ended = ""
        self._process: subprocess.Popen[bytes] | None = None
        self._replies = -1
        self._printed = bytearray()
        self._drain: threading.Thread | None = None
        self._used = Used()
        self.usual: Callable[[], float] = float
        """Seconds that the call which it is at may take, for what a right function takes on this machine."""

    @property
    def running(self) -> bool:
        """True if there is one."""
        return self._process is not None and self._process.poll() is None

    @property
    def printed(self) -> str:
        """The text that it and those before it have printed so far, cut."""
        return bytes(self._printed).decode("utf-8", "replace")

    def start(self) -> None:
        """Start it; there must be none."""
        self._replies, theirs = os.pipe()
        user = worker_user(next(_NUMBERS))
        settings = {
            "path": self._sandbox.path,
            "readable": self._sandbox.readable if self._sandbox.hooked else (),
            "wall": self._sandbox.wall(user),
            "reply": theirs,
            "limits": {
                "CPU": self._limits.cpu_seconds,
                "AS": self._limits.memory,
                "CORE": 0,
                "FSIZE": 0,
                "NOFILE": 64,
            },
        }
        popen: Callable[..., subprocess.Popen[bytes]] = subprocess.Popen
        try:
            self._process = _STARTER.submit(
                popen,
                [
                    *self._sandbox.command,
                    f"{self._sandbox.path[0]}/program.py",
                    json.dumps(settings),
                ],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                pass_fds=(theirs,),
                start_new_session=True,
                **self._sandbox.starting(user),
            ).result()
        finally:
            os.close(theirs)
        assert self._process.stdin is not None
        os.set_blocking(self._process.stdin.fileno(), False)
        for pipe in (self._process.stdin.fileno(), self._replies):
            _widen(pipe)
        self._ended = ""
        self._drain = threading.Thread(
            target=self._keep_printed, args=(self._process,), daemon=True
        )
        self._drain.start()
        self._budget.watch(self._process.pid, partial(self._end, self._process))
        self._used = Used()

    @property
    def ended(self) -> str:
        """Why the grader itself has ended it, for what it used; empty if it hasn't."""
        return self._ended

    def close(self) -> None:
        """End the process, if there is one, and everything that it may have started."""
        with self._guard:
            process, self._process = self._process, None
        if process is None:
            return
        self._budget.forget(process.pid)
        _kill(process)
        process.wait()
        if process.stdin is not None:
            with contextlib.suppress(OSError):
                process.stdin.close()
        os.close(self._replies)
        # A daemon that escaped would keep the pipe open; nobody waits for it.
        if self._drain is not None and self._drain.is_alive():
            self._drain.join(0.5)
        elif process.stdout is not None:
            # Ctrl-C may have come before the thread was started.
            process.stdout.close()

    def write(self, message: bytes, deadline: float) -> None:
        """Send a message.

        Raises StudentError: it was not taken in time, or the process has ended.
        ``deadline``: ``time.monotonic()`` at which the process is ended, if it has had a processor for so long
        """
        self._used.mark()
        assert self._process is not None
        assert self._process.stdin is not None
        data = memoryview(message)
        pipe = self._process.stdin.fileno()
        clock = Clock(deadline, self._used, self.usual)
        while data:
            self._wait(clock, write=[pipe])
            try:
                data = data[os.write(pipe, data) :]
            except BlockingIOError:
                continue
            except OSError:
                raise self.lost("the process is gone", gone=True) from None

    def read(self, deadline: float) -> tuple[dict[str, Any], list[Any]]:
        """The head and the values of a reply.

        Raises StudentError: there is none in time, or none that can be read.
        ``deadline``: as in ``write``
        """
        try:
            reply = unpack(self._reader(deadline), generators=False)
        except BrokenMessage as error:
            raise self.lost(f"what it wrote is no reply ({error})") from None
        except MemoryError:
            # What is left of it in the pipe would be taken for the next reply.
            raise self.lost("its reply is too large for the grader") from None
        if self._used.nobody and self._process is not None:
            # With its first reply a sandbox has started all that it is made of.
            self._used = Used(self._process.pid)
        return reply

    def lost(self, why: str, gone: bool = False) -> StudentError:
        """The error of a process that can't be used any more, and is ended; with what has ended it, if it had.

        ``gone``: whether it has let go of its pipes, so that it ends by itself, or has
        """
        code = None
        if self._process is not None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                code = self._process.wait(0.5 if gone else 0.0)
        self.close()
        meaning = {
            -signal.SIGXCPU: f"; it used more than {self._limits.cpu_seconds} s of processor time",
            -signal.SIGSEGV: "; a segmentation fault",
            -signal.SIGKILL: "; it was killed",
        }.get(code or 0, "")
        if self._ended:
            meaning = f"; {self._ended}"
        return StudentError("crashed", f"{why}{meaning}")

    def _wait(self, clock: Clock, read: Sequence[int] = (), write: Sequence[int] = ()) -> None:
        """Until there is something to read, or room to write; the process is ended where that takes too long."""
        while not (there := any(select.select(read, write, [], clock.left()))) and not clock.over():
            pass
        if not there or clock.long_over():
            self.close()
            raise StudentError("timeout", "no answer in time")

    def _reader(self, deadline: float) -> Callable[[int], bytearray]:
        clock = Clock(deadline, self._used, self.usual)

        def read(count: int) -> bytearray:
            data = bytearray(count)
            rest = memoryview(data)
            while rest:
                self._wait(clock, read=[self._replies])
                got = os.readv(self._replies, [rest])
                if not got:
                    raise self.lost("the process has ended", gone=True)
                rest = rest[got:]
            return data

        return read

    def _end(self, process: subprocess.Popen[bytes], why: str) -> None:
        """End it from another thread, if it is still the one; whoever waits for it is told why."""
        with self._guard:
            if self._process is process and process.poll() is None:
                self._ended = why
                _kill(process)

    def _keep_printed(self, process: subprocess.Popen[bytes]) -> None:
        printed = 0
        pipe: Any = process.stdout
        with pipe:
            while data := pipe.read1(65536):
                printed += len(data)
                if printed > MOST_PRINTED:
                    # Read on until it is gone: to hang up would be an exception in it, which it could tell.
                    self._end(process, f"it printed more than {MOST_PRINTED >> 20} MB")
                room = SHOWN - len(self._printed)
                if room > 0:
                    self._printed += data[:room]
                    if len(data) > room:
                        self._printed += b"\n... (more was printed)"


def _kill(process: subprocess.Popen[bytes]) -> None:
    """Kill it with its group."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()


def _widen(pipe: int) -> None:
    """Room for a batch of rays, where the system allows it: fewer turns between the two processes."""
    with contextlib.suppress(ImportError, AttributeError, OSError):
        import fcntl

        fcntl.fcntl(pipe, fcntl.F_SETPIPE_SZ, 1 << 20)
