"""The grader's end of a worker: calls in, values out, and every way in which that can go wrong told apart."""

from __future__ import annotations

import contextlib
import json
import os
import select
import signal
import subprocess
import threading
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from time import monotonic
from types import TracebackType
from typing import Any

import numpy as np

from course.grading.checks.check import Caller
from course.grading.errors import StudentError
from course.grading.worker.framing import BrokenMessage, pack, unpack
from course.grading.worker.patience import Patience
from course.grading.worker.sandbox import Sandbox, program, sandbox
from course.grading.worker.wording import no_such, not_loaded, replied

LARGEST_SOURCE = 1_000_000
"""Bytes; a file that is larger was not written by a student."""

_STARTER = ThreadPoolExecutor(1, thread_name_prefix="starts-workers")
"""All workers are started from one thread that lives as long as this process: a sandbox dies with the *thread* that
started it, and threads that render come and go."""

SHOWN = 4000
"""Characters of what a student prints that are kept."""


@dataclass(frozen=True)
class Limits:
    """What one worker may use.

    Attributes
    ----------
    call_seconds : wall clock of importing the file, and of one call at most; ``Patience`` says when it is less
    cpu_seconds : processor time of one worker process
    memory : bytes of address space
    deaths : processes that the calls of one function may end before it isn't called again
    """

    call_seconds: float = 10.0
    cpu_seconds: int = 60
    memory: int = 2 << 30
    deaths: int = 4


class Worker:
    """A ``Caller`` whose functions run in a process of their own.

    The process is started at the first call, and again at the first call after it has died. Use it as a context, or
    call ``close``.

    Parameters
    ----------
    module : its name, "thin_lens"
    source : the student's file
    limits : what it may use
    shut_in : how it is started; the best that the machine has if not given
    lender, lent : functions of the module, by name, that take the place of the student's own when other functions of
        the module call them; they are worked out by ``lender``, on this side of the pipe
    patience : shared by all workers of the module; one of its own if not given
    trouble : why there is nothing to import; None if there is
    """

    def __init__(
        self,
        module: str,
        source: bytes,
        limits: Limits = Limits(),
        shut_in: Sandbox | None = None,
        lender: Caller | None = None,
        lent: Sequence[str] = (),
        patience: Patience | None = None,
        trouble: StudentError | None = None,
    ) -> None:
        self.module = module
        self._lender, self._lent = lender, tuple(lent)
        self.limits = limits
        self.sandbox = shut_in or sandbox()
        self._source = source
        self._process: subprocess.Popen[bytes] | None = None
        self._replies = -1
        self._deaths: Counter[str] = Counter()
        self._broken = trouble
        self._patience = patience or Patience(limits.call_seconds)
        self._answered: set[str] = set()
        self._names: Any = []
        self._printed = bytearray()
        self._drain: threading.Thread | None = None
        self._lock = threading.Lock()
        if len(source) > LARGEST_SOURCE:
            self._broken = StudentError(
                "not loaded",
                f"{module}.py has {len(source):,} bytes; more than {LARGEST_SOURCE:,} are not read",
                module_wide=True,
            )

    def __enter__(self) -> Worker:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    @property
    def printed(self) -> str:
        """What the student's code has printed so far, cut."""
        return bytes(self._printed).decode("utf-8", "replace")

    def load(self) -> None:
        """Import the file, if it hasn't been.

        Raises
        ------
        StudentError
            It can't be; no call will do better, and none tries again.
        """
        with self._lock:
            self._ready()

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        """The function's value.

        Raises
        ------
        StudentError
            There is none; its ``kind`` says why.
        """
        values, _ = self._ask(function, arguments, named, look=False)
        return values[0]

    def call_and_look(self, function: str, *arguments: Any) -> tuple[Any, list[Any], bool]:
        """The value, the arguments as they are after the call, and whether NumPy's global random state moved."""
        values, head = self._ask(function, arguments, {}, look=True)
        return values[0], values[1:], bool(head.get("moved"))

    def close(self) -> None:
        """End the process and everything that it may have started."""
        process, self._process = self._process, None
        if process is None:
            return
        with contextlib.suppress(ProcessLookupError, PermissionError):
            if hasattr(os, "killpg"):
                os.killpg(process.pid, signal.SIGKILL)
            else:
                process.kill()
        process.wait()
        if process.stdin is not None:
            with contextlib.suppress(OSError):
                process.stdin.close()
        os.close(self._replies)
        if self._drain is not None:
            # A daemon that escaped would keep the pipe open; nobody waits for it.
            self._drain.join(0.5)

    def _ask(
        self, function: str, arguments: tuple[Any, ...], named: dict[str, Any], *, look: bool
    ) -> tuple[list[Any], dict[str, Any]]:
        with self._lock:
            if self._deaths[function] >= self.limits.deaths:
                raise StudentError(
                    "crashed",
                    f"it has ended its process {self._deaths[function]} times; it isn't called again",
                )
            self._ready()
            limit = self._patience.limit(function in self._answered)
            head = {"function": function, "names": [*named], "look": look}
            message = pack(head, [*arguments, *named.values()])
            try:
                head, values = self._exchange(message, monotonic() + limit)
                if head.get("error") == "missing":
                    raise no_such(self.module, function, self._names)
                self._raise(head)
                if len(values) != 1 + (len(arguments) if look else 0):
                    raise self._lost("its replies are not replies to calls")
            except StudentError as error:
                if error.kind == "crashed":
                    self._deaths[function] += 1
                if error.kind != "timeout":
                    raise
                why = str(self._patience)
                self._patience.lose(limit)
                raise StudentError("timeout", f"no answer within {limit:.3g} s{why}") from None
            self._answered.add(function)
            return values, head

    def _ready(self) -> None:
        """Start the process if there is none."""
        if self._broken is not None:
            raise self._broken
        if self._process is not None and self._process.poll() is None:
            return
        self.close()
        self._start()
        # Python's own start is not the student's time.
        self._exchange(
            pack(
                {"module": self.module, "lent": self._lent}, [np.frombuffer(self._source, np.uint8)]
            ),
            monotonic() + 60,
        )
        try:
            head, _ = self._read(monotonic() + self.limits.call_seconds)
            self._raise(head)
        except StudentError as error:
            self.close()
            # No call tries again: it would be waited for as long, and end no better.
            self._broken = not_loaded(self.module, error, self.limits.call_seconds)
            raise self._broken from None
        self._names = head.get("names")

    def _start(self) -> None:
        self._replies, theirs = os.pipe()
        settings = {
            "path": self.sandbox.path,
            "readable": self.sandbox.readable,
            "reply": theirs,
            "limits": {
                "CPU": self.limits.cpu_seconds,
                "AS": self.limits.memory,
                "CORE": 0,
                "FSIZE": 0,
                "NOFILE": 64,
            },
        }
        try:
            self._process = _STARTER.submit(
                subprocess.Popen,
                [*self.sandbox.command, program(self.sandbox), json.dumps(settings)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                pass_fds=(theirs,),
                start_new_session=True,
                cwd="/" if os.name == "posix" else None,
                env={"OPENBLAS_NUM_THREADS": "1", "PYTHONHASHSEED": "0"},
            ).result()
        finally:
            os.close(theirs)
        assert self._process.stdin is not None
        os.set_blocking(self._process.stdin.fileno(), False)
        for pipe in (self._process.stdin.fileno(), self._replies):
            _widen(pipe)
        self._drain = threading.Thread(
            target=self._keep_printed, args=(self._process.stdout,), daemon=True
        )
        self._drain.start()

    def _keep_printed(self, pipe: Any) -> None:
        with pipe:
            while data := pipe.read1(65536):
                room = SHOWN - len(self._printed)
                if room > 0:
                    self._printed += data[:room]
                    if len(data) > room:
                        self._printed += b"\n... (more was printed)"

    def _exchange(self, message: bytes, deadline: float) -> tuple[dict[str, Any], list[Any]]:
        self._write(message, deadline)
        head, values = self._read(deadline)
        while "borrowed" in head:
            self._write(self._worked_out(head, values), deadline)
            head, values = self._read(deadline)
        return head, values

    def _worked_out(self, head: dict[str, Any], values: list[Any]) -> bytes:
        name, names = head["borrowed"], head.get("names")
        if self._lender is None or name not in self._lent or not isinstance(names, list):
            raise self._lost("it asks for what it hasn't been lent")
        split = len(values) - len(names)
        named = dict(zip(map(str, names), values[split:], strict=False))
        try:
            return pack({}, [self._lender.call(name, *values[:split], **named)])
        except StudentError as error:
            return pack({"error": error.kind, "type": error.type, "message": str(error)}, [])

    def _write(self, message: bytes, deadline: float) -> None:
        assert self._process is not None
        assert self._process.stdin is not None
        data = memoryview(message)
        pipe = self._process.stdin.fileno()
        while data:
            _, ready, _ = select.select([], [pipe], [], max(deadline - monotonic(), 0))
            if not ready:
                raise self._timeout()
            try:
                data = data[os.write(pipe, data) :]
            except BlockingIOError:
                continue
            except OSError:
                raise self._lost("the process is gone") from None

    def _read(self, deadline: float) -> tuple[dict[str, Any], list[Any]]:
        try:
            return unpack(self._reader(deadline))
        except BrokenMessage as error:
            raise self._lost(f"what it wrote is no reply ({error})") from None

    def _reader(self, deadline: float) -> Callable[[int], bytearray]:
        def read(count: int) -> bytearray:
            data = bytearray(count)
            rest = memoryview(data)
            while rest:
                ready, _, _ = select.select([self._replies], [], [], max(deadline - monotonic(), 0))
                if not ready:
                    raise self._timeout()
                got = os.readv(self._replies, [rest])
                if not got:
                    raise self._lost("the process has ended")
                rest = rest[got:]
            return data

        return read

    def _raise(self, head: dict[str, Any]) -> None:
        kind = head.get("error")
        if kind is None:
            return
        if kind not in ("not written", "raised", "bad value"):
            raise self._lost("its replies are not replies to calls")
        raise replied(kind, head)

    def _timeout(self) -> StudentError:
        self.close()
        return StudentError("timeout", "no answer in time")

    def _lost(self, why: str) -> StudentError:
        process = self._process
        code = None
        if process is not None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                code = process.wait(0.5)
        self.close()
        meaning = {
            -signal.SIGXCPU: f"; it used more than {self.limits.cpu_seconds} s of processor time",
            -signal.SIGSEGV: "; a segmentation fault",
            -signal.SIGKILL: "; it was killed",
        }.get(code or 0, "")
        return StudentError("crashed", f"{why}{meaning}")


def _widen(pipe: int) -> None:
    """Room for a batch of rays, where the system allows it: fewer turns between the two processes."""
    with contextlib.suppress(ImportError, AttributeError, OSError):
        import fcntl

        fcntl.fcntl(pipe, fcntl.F_SETPIPE_SZ, 1 << 20)
