"""The grader's end of a worker: calls in, values out, and every way in which that can go wrong told apart."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Sequence
from time import monotonic
from types import TracebackType
from typing import Any

import numpy as np

from course.grading.checks.check import Caller
from course.grading.errors import StudentError
from course.grading.worker.framing import pack
from course.grading.worker.limits import Limits
from course.grading.worker.patience import Patience
from course.grading.worker.process import Process
from course.grading.worker.sandbox import Sandbox, sandbox
from course.grading.worker.wording import no_such, not_loaded, replied

LARGEST_SOURCE = 1_000_000
"""Bytes; a file that is larger was not written by a student."""


class Worker:
    """A ``Caller`` whose functions run in a process of their own.

    The process is started at the first call, and again at the first call after it has died. Use it as a context, or
    call ``close``.

    Parameters
    ----------
    module : its name, "thin_lens"
    source : the student's file
    limits : what it may use; the usual if not given
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
        limits: Limits | None = None,
        shut_in: Sandbox | None = None,
        lender: Caller | None = None,
        lent: Sequence[str] = (),
        patience: Patience | None = None,
        trouble: StudentError | None = None,
    ) -> None:
        self.module = module
        self._lender, self._lent = lender, tuple(lent)
        self.limits = limits or Limits()
        self.sandbox = shut_in or sandbox()
        self._source = source
        self._process = Process(self.sandbox, self.limits)
        self._deaths: Counter[str] = Counter()
        self._broken = trouble
        self._patience = patience or Patience(self.limits.call_seconds)
        self._answered: set[str] = set()
        self._names: Any = []
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
        return self._process.printed

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
        self._process.close()

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
                    raise self._process.lost("its replies are not replies to calls")
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
        if self._process.running:
            return
        self.close()
        self._start()
        try:
            head, _ = self._process.read(monotonic() + self.limits.call_seconds)
            self._raise(head)
        except StudentError as error:
            self.close()
            # No call tries again: it would be waited for as long, and end no better.
            self._broken = not_loaded(self.module, error, self.limits.call_seconds)
            raise self._broken from None
        self._names = head.get("names")

    def _start(self) -> None:
        """Start the process, up to where it imports the file: that is not the student's time."""
        self._process.start()
        source = np.frombuffer(self._source, np.uint8)
        self._exchange(
            pack({"module": self.module, "lent": self._lent}, [source]), monotonic() + 60
        )

    def _exchange(self, message: bytes, deadline: float) -> tuple[dict[str, Any], list[Any]]:
        self._process.write(message, deadline)
        head, values = self._process.read(deadline)
        while "borrowed" in head:
            self._process.write(self._worked_out(head, values), deadline)
            head, values = self._process.read(deadline)
        return head, values

    def _worked_out(self, head: dict[str, Any], values: list[Any]) -> bytes:
        name, names = head["borrowed"], head.get("names")
        if self._lender is None or name not in self._lent or not isinstance(names, list):
            raise self._process.lost("it asks for what it hasn't been lent")
        split = len(values) - len(names)
        named = dict(zip(map(str, names), values[split:], strict=False))
        try:
            return pack({}, [self._lender.call(name, *values[:split], **named)])
        except StudentError as error:
            return pack({"error": error.kind, "type": error.type, "message": str(error)}, [])

    def _raise(self, head: dict[str, Any]) -> None:
        kind = head.get("error")
        if kind is None:
            return
        if kind not in ("not written", "raised", "bad value"):
            raise self._process.lost("its replies are not replies to calls")
        raise replied(kind, head)
