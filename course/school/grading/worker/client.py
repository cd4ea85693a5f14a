"""The grader's end of a worker: calls in, values out, and every way in which that can go wrong told apart."""

import threading
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from time import monotonic
from typing import Any, NamedTuple

import numpy as np

from course.school.grading.errors import StudentError
from course.school.grading.looked import EARLIER_RESULT, RANDOM_STATE, Looked
from course.school.grading.worker.framing import BrokenMessage, generator, pack
from course.school.grading.worker.limits import Limits, TimeBudget, WorkerBudget
from course.school.grading.worker.process import Process
from course.school.grading.worker.sandbox import Sandbox, sandbox
from course.school.grading.worker.wording import no_such, not_loaded, replied, said

LARGEST_SOURCE = 1_000_000
"""Bytes; a file that is larger was not written by a student."""

SHORT = 1.0
"""Seconds that starting a process and importing a file again may take, for which no module loses time."""


class _Call(NamedTuple):
    """A call as it is asked of a worker; to look is to have the arguments sent back."""

    function: str
    arguments: tuple[Any, ...]
    named: dict[str, Any]
    look: bool = False


LOOPS = 1000
"""Times as long as the reference a loop in plain Python takes at the most, by what operations on numbers cost in it."""

MOST_SECONDS = 60.0
"""Of processor time that any call may take."""

_Reply = tuple[list[Any], dict[str, Any]]
"""Values and head."""


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
    substitute, lent : functions of the module, by name, that take the place of the student's own when other
        functions of the module call them; they are worked out by ``substitute``, a worker of the course's own, which is
        closed with this
    time_budget : shared by all workers of the module; one of its own if not given
    budget : shared by all workers of the submission; one of its own if not given
    trouble : why there is nothing to import; None if there is
    """

    def __init__(
        self,
        module: str,
        source: bytes,
        limits: Limits | None = None,
        shut_in: Sandbox | None = None,
        substitute: "Worker | None" = None,
        lent: Sequence[str] = (),
        time_budget: TimeBudget | None = None,
        budget: WorkerBudget | None = None,
        trouble: StudentError | None = None,
    ) -> None:
        self.module = module
        self.reference_caller: Worker | None = None
        """The reference's: a call that is late may take as long as a plain loop would, by what it takes there."""
        self._substitute, self._lent = substitute, tuple(lent)
        self.borrowed = False
        """Whether a function that is lent has been asked for."""
        self.limits = limits or Limits()
        self.sandbox = shut_in or sandbox()
        self._source = source
        self._budget = budget or WorkerBudget(self.limits)
        self._process = Process(self.sandbox, self.limits, self._budget)
        self._deaths: Counter[str] = Counter()
        self._broken = trouble
        self._time_budget = time_budget or TimeBudget(self.limits.call_seconds)
        self._answered: set[str] = set()
        self._imported = False
        self._names: Any = []
        self._calls: frozenset[str] = frozenset()
        self._lock = threading.Lock()
        if len(source) > LARGEST_SOURCE:
            self._broken = StudentError(
                "not loaded",
                f"{module}.py has {len(source):,} bytes; more than {LARGEST_SOURCE:,} are not read",
                module_wide=True,
            )

    def __enter__(self) -> "Worker":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def printed(self) -> str:
        """The text that the student's code has printed so far, cut."""
        return self._process.printed

    def load(self) -> None:
        """Import the file, if it hasn't been; ``StudentError`` where it can't be, and then no call tries again."""
        with self._lock:
            self._ready()

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        """The function's value; ``StudentError`` where there is none, whose ``kind`` says why."""
        values, _ = self._ask(_Call(function, arguments, named))
        return values[0]

    def call_and_look(self, function: str, *arguments: Any) -> Looked:
        """See ``Caller``."""
        values, head = self._ask(_Call(function, arguments, {}, look=True))
        pairs = zip(arguments, values[1:], strict=True)
        try:
            after = [
                generator(came) if isinstance(went, np.random.Generator) else came
                for went, came in pairs
            ]
        except BrokenMessage as error:
            raise self._process.lost(f"what it wrote is no reply ({error})") from None
        changed = {RANDOM_STATE: head.get("moved"), EARLIER_RESULT: head.get("overwrote")}
        return values[0], after, frozenset(what for what, so in changed.items() if so)

    def lend(self, call: _Call, deadline: float) -> Any:
        """The value of a call, for another worker whose own call has to end at the deadline.

        Raises StudentError: "timeout": it took longer; no time budget is used.
        """
        with self._lock:
            self._ready()
            return self._once(call, deadline)[0][0]

    def calls(self, function: str, other: str) -> bool:
        """True if the student's function calls another of the same file; as the worker says, so good for a hint."""
        return f"{function}>{other}" in self._calls

    def close(self) -> None:
        """End the process and everything that it may have started; the next call starts another."""
        self._process.close()
        if self._substitute is not None:
            self._substitute.close()

    def _ask(self, call: _Call) -> _Reply:
        """The values and the head of a reply.

        A call that ends its process is made once more in a fresh one, for something else may have ended it: where
        memory is short the system kills whom it likes.
        """
        with self._lock:
            try:
                return self._counted(call)
            except StudentError as error:
                if error.kind != "crashed" or error.module_wide or self._process.ended:
                    raise
                if self._deaths[call.function] >= self.limits.deaths:
                    raise
                return self._counted(call)

    def _counted(self, call: _Call) -> _Reply:
        """One call, and what it costs: of the function's deaths and of the module's time budget."""
        function = call.function
        if (deaths := self._deaths[function]) >= self.limits.deaths:
            raise StudentError(
                "crashed", f"it has ended its process {deaths} times; it isn't called again"
            )
        # Nor is a file imported again for a call that has no time.
        self._time_budget.limit(function in self._answered)
        self._ready()
        limit = self._budget.at_most(self._time_budget.limit(function in self._answered))
        try:
            reply = self._once(call, monotonic() + limit)
        except StudentError as error:
            if error.kind == "crashed":
                self._deaths[function] += 1
            if error.kind != "timeout":
                raise
            # A call that the submission's end has cut short may be a right one: it costs nothing of the time budget.
            if over := self._budget.over:
                raise StudentError("timeout", f"no answer yet, and {over}") from None
            why = str(self._time_budget)
            self._time_budget.lose(limit)
            raise StudentError("timeout", f"no answer within {limit:.3g} s{why}") from None
        self._answered.add(function)
        return reply

    def _once(self, call: _Call, deadline: float) -> _Reply:
        function, arguments, named, look = call
        self._process.usual = partial(self._usual, call)
        message = pack(
            {"function": function, "names": [*named], "look": look}, [*arguments, *named.values()]
        )
        head, values = self._exchange(message, deadline)
        if head.get("error") == "missing":
            raise no_such(self.module, function, self._names)
        if "error" in head:
            self._raise(head, said(f"{self.module}.{function}", arguments, named))
        if len(values) != 1 + (len(arguments) if look else 0):
            raise self._process.lost("its replies are not replies to calls")
        return values, head

    def _usual(self, call: _Call) -> float:
        """Seconds that a plain loop would take for a call, by what the reference takes; 0 where that is not known."""
        if self.reference_caller is None:
            return 0.0
        with suppress(StudentError):
            return min(LOOPS * self.reference_caller.seconds(call), MOST_SECONDS)
        return 0.0

    def seconds(self, call: _Call) -> float:
        """How long a call takes: by the clock, for those of right functions are too short to count ticks.

        Of the second of two: the first call in a process takes many times as long.
        """
        with self._lock:
            self._ready()
            self._once(call, monotonic() + self.limits.call_seconds)
            begun = monotonic()
            self._once(call, begun + self.limits.call_seconds)
            return monotonic() - begun

    def _ready(self) -> None:
        """Start the process if there is none; once more if it ends in importing the file."""
        if self._broken is not None:
            raise self._broken
        if self._process.running:
            return
        for last in (False, True):
            seconds, begun = self._budget.at_most(self.limits.call_seconds), monotonic()
            try:
                head = self._started(seconds)
                # To import a file again may take as long as the first time, which isn't counted.
                long = monotonic() - begun - SHORT
                if self._imported and long > 0:
                    self._time_budget.lose(long)
                self._imported = True
                break
            except StudentError as error:
                self._process.close()
                if error.kind == "crashed" and not last and not self._process.ended:
                    continue
                # No call tries again: it would be waited for as long, and end no better.
                over = self._budget.over if error.kind == "timeout" else ""
                self._broken = not_loaded(self.module, error, seconds, over)
                raise self._broken from None
        self._names = head.get("names")
        calls = head.get("calls")
        calls = calls if isinstance(calls, list) else []
        self._calls = frozenset(call for call in calls if isinstance(call, str))

    def _started(self, seconds: float) -> dict[str, Any]:
        """The head that a new process sends when it has imported the file."""
        self._start()
        self._process.usual = float
        head, _ = self._process.read(monotonic() + seconds)
        self._raise(head)
        return head

    def _start(self) -> None:
        """Start the process, up to where it imports the file: that is not the student's time."""
        self._process.close()
        self._process.start()
        source = np.frombuffer(self._source, np.uint8)
        self._exchange(
            pack({"module": self.module, "lent": [*self._lent]}, [source]), monotonic() + 60
        )

    def _exchange(self, message: bytes, deadline: float) -> tuple[dict[str, Any], list[Any]]:
        self._process.write(message, deadline)
        head, values = self._process.read(deadline)
        if "borrowed" in head:
            self.borrowed = True
            # To start the substitute is not the student's time.
            deadline += self._substitute_ready()
        while "borrowed" in head:
            self._process.write(self._worked_out(head, values, deadline), deadline)
            head, values = self._process.read(deadline)
        return head, values

    def _substitute_ready(self) -> float:
        """How long that took [s]."""
        started = monotonic()
        if self._substitute is not None:
            self._substitute.load()
        return monotonic() - started

    def _worked_out(self, head: dict[str, Any], values: list[Any], deadline: float) -> bytes:
        """The reply of a function that the worker has been lent; within the time and memory of the call that asks."""
        name, names = head["borrowed"], head.get("names")
        if (
            self._substitute is None
            or name not in self._lent
            or type(names) is not list
            or len(names) > len(values)
            or not all(type(each) is str for each in names)
        ):
            raise self._process.lost("it asks for what it hasn't been lent")
        split = len(values) - len(names)
        named = dict(zip(names, values[split:], strict=True))
        try:
            asked = _Call(name, tuple(values[:split]), named)
            return pack({}, [self._substitute.lend(asked, deadline)])
        except StudentError as error:
            if error.kind == "timeout":
                self._process.close()
                raise
            return pack({"error": error.kind, "type": error.type, "message": str(error)}, [])

    def _raise(self, head: dict[str, Any], arguments: str = "") -> None:
        kind = head.get("error")
        if kind is None:
            return
        if kind not in ("not written", "raised", "bad value"):
            raise self._process.lost("its replies are not replies to calls")
        raise replied(kind, head, arguments)
