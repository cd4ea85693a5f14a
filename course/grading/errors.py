"""What can go wrong with student code: each is a result of grading, not a fault of the grader."""

from __future__ import annotations

from typing import Literal

from course.errors import CourseError

Trouble = Literal["not written", "raised", "bad value", "timeout", "crashed", "not loaded"]


class StudentError(CourseError):
    """A call of a student's function gave no usable value.

    Attributes
    ----------
    kind : what happened; "not loaded" when the file can't be imported, "bad value" when what came back is no number
        or plain array
    type : the exception's class where one was raised
    traceback : of the student's own lines, cut
    """

    def __init__(self, kind: Trouble, message: str, type: str = "", traceback: str = "") -> None:  # noqa: A002
        super().__init__(message)
        self.kind, self.type, self.traceback = kind, type, traceback
