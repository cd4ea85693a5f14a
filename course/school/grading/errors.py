"""Errors of student code: each is a result of grading, not a fault of the grader."""

import re
from typing import Literal

from course.base.errors import CourseError

Trouble = Literal[
    "not written", "missing", "raised", "bad value", "timeout", "crashed", "not loaded"
]


class StudentError(CourseError):
    """A call of a student's function gave no usable value.

    Attributes
    ----------
    kind : what happened; "not loaded" when the file can't be imported, "missing" when it hasn't the function, "bad
        value" when what came back is no number or plain array
    type : the exception's class where one was raised
    traceback : of the student's own lines, cut
    module_wide : whether no function of the module can be called
    arguments : of the call, in a line; empty where they say nothing
    remedy : what to do, where the exception is one that many have met
    """

    def __init__(
        self,
        kind: Trouble,
        message: str,
        type: str = "",  # noqa: A002
        traceback: str = "",
        *,
        module_wide: bool = False,
        arguments: str = "",
        remedy: str = "",
    ) -> None:
        super().__init__(message)
        self.kind, self.type, self.traceback = kind, type, traceback
        self.module_wide = module_wide
        self.arguments, self.remedy = arguments, remedy
        self.expected = "a value"
        """What should have come in its place."""
        self.example = ""
        """The smallest call that gives no usable value, where somebody has looked for it."""

    @property
    def cause(self) -> str:
        """The same for two errors that have one cause, however many columns they came with.

        An exception is known by the lines that it came through, anything else by its text without the numbers.
        """
        frames = [line for line in self.traceback.splitlines() if line.startswith(" ")]
        frames = [line for line in frames if not line.startswith("  [Previous line repeated")]
        return "\n".join((self.kind, self.type, *(frames or [re.sub(r"\d+", "#", str(self))])))
