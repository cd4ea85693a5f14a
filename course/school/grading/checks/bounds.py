"""The bounds of a closer look: of what follows a failed check, and earns nobody a point."""

from time import monotonic
from typing import Any, TypeVar

from course.school.grading.checks.check import Caller
from course.school.grading.errors import StudentError
from course.school.grading.looked import Looked

Value = TypeVar("Value")

MOST_BYTES = 1 << 26
"""Of all values together; those of right functions come to 17 MB at the most."""

MOST_SECONDS = 20.0
"""Of all calls together, and of what is done between them."""


class Bounded:
    """A ``Caller`` for one closer look, which ends by a StudentError ("timeout") where it is over its bounds.

    ``caller``: of the student's functions
    """

    def __init__(self, caller: Caller) -> None:
        self.over = ""
        """What it is over; empty while it isn't."""
        self._caller = caller
        self._bytes, self._until = 0, monotonic() + MOST_SECONDS

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        """The function's value."""
        self._on_time()
        return self._weighed(self._caller.call(function, *arguments, **named))

    def call_and_look(self, function: str, *arguments: Any) -> Looked:
        """See ``Caller``."""
        self._on_time()
        return self._weighed(self._caller.call_and_look(function, *arguments))

    def _on_time(self) -> None:
        if monotonic() > self._until:
            self._end(f"its calls take more than {MOST_SECONDS:g} s together")

    def _weighed(self, value: Value) -> Value:
        self._bytes += _bytes(value)
        if self._bytes > MOST_BYTES:
            self._end(f"its results have more than {MOST_BYTES >> 20} MB together")
        return value

    def _end(self, why: str) -> None:
        self.over = why
        raise StudentError("timeout", why)


def _bytes(value: Any) -> int:
    if isinstance(value, tuple | list):
        return sum(map(_bytes, value))
    return int(getattr(value, "nbytes", 0))
