"""How a check ended: what is shown, kept and counted of it."""

from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

from course.base.texts import clean
from course.school.grading.checks.check import Check, Figure
from course.school.grading.errors import StudentError

NOT_WRITTEN = "not written yet"
"""Of a function that is still the stub's."""


class Status(StrEnum):
    """How a check ended."""

    PASSED = "passed"
    FAILED = "failed"
    NOT_ATTEMPTED = "not attempted"
    TIMEOUT = "timeout"
    CRASHED = "crashed"
    GRADER_ERROR = "grader error"


@dataclass(frozen=True)
class Result:
    """How one check ended.

    Attributes
    ----------
    module, function, check, title : which one
    kind : which sort of check it is
    status : how
    points, of : what it earned, and what it could; a grader's error earns all
    expected, found, where, hint : what a failure says
    example : the smallest input that shows it, with what came and what must hold
    mistake, says : the known mistake that the function makes, if it is one
    seconds : it took
    figures : what there is to draw
    same_as : the id of an earlier result that says the same, with more about it; empty if this is the first
    module_wide : whether it is about the whole module, of which no function could be called
    broken : whether the check itself broke, whatever came of it
    instructor : how it broke; for those who write checks, and in nothing that students see
    """

    module: str
    function: str
    check: str
    title: str
    kind: str
    status: Status
    points: float
    of: float
    expected: str = ""
    found: str = ""
    where: str = ""
    hint: str = ""
    mistake: str = ""
    says: str = ""
    seconds: float = 0.0
    figures: tuple[Figure, ...] = ()
    same_as: str = ""
    module_wide: bool = False
    example: str = ""
    broken: bool = False
    instructor: str = ""

    @property
    def id(self) -> str:
        """Such as "thin_lens.point_on_disk/uniform"."""
        return f"{self.module}.{self.function}/{self.check}"


_TOLD = ("expected", "found", "where", "hint", "example", "says", "instructor")
"""What may hold a student's text."""


def cleaned(result: Result) -> Result:
    """The result with texts that are fit for every report and terminal."""
    told: dict[str, Any] = {name: clean(getattr(result, name)) for name in _TOLD}
    return replace(result, **told)


def troubled(module: str, check: Check, error: StudentError) -> Result:
    """The result of a check whose function gave no value."""
    status = {
        "not written": Status.NOT_ATTEMPTED,
        "missing": Status.NOT_ATTEMPTED,
        "timeout": Status.TIMEOUT,
        "crashed": Status.CRASHED,
    }.get(error.kind, Status.FAILED)
    found = f"{error.type}: {error}" if error.kind == "raised" else str(error)
    expected = "" if error.kind == "missing" else error.expected
    called_with = error.arguments and f"arguments: {error.arguments}"
    where = "\n".join(filter(None, (error.traceback.rstrip(), called_with)))
    told = {"expected": expected, "found": found, "where": where, "hint": error.remedy}
    return result_of(module, check, status, **told, example=error.example or error.arguments)


BROKEN = "the check itself broke"


def broken(module: str, check: Check, reference_too: bool | None, last: str) -> Result:
    """The result of a check that broke.

    Parameters
    ----------
    reference_too : whether it breaks with the reference as well; None where there is none to try
    last : what the student's function had returned before
    """
    if reference_too:
        found = f"{BROKEN}, as it does with the course's own function"
        hint = "This is no fault of yours, and its points are given; please pass it on."
        return result_of(module, check, Status.GRADER_ERROR, found=found, hint=hint, broken=True)
    why = "With the course's own function it doesn't."
    if reference_too is None:
        why = (
            "Whose fault it is can't be told in a copy without solutions: here it gives no points."
        )
    expected, hint = "a result that the check can work with", f"On this {BROKEN}. {why}"
    told = {"expected": expected, "found": last, "hint": hint}
    return result_of(module, check, Status.FAILED, **told, broken=True)


def result_of(module: str, check: Check, status: Status, **more: Any) -> Result:
    """The result of a check, with the points that the status earns.

    ``more``: further attributes of the result, by name
    """
    earned = check.points if status in (Status.PASSED, Status.GRADER_ERROR) else 0.0
    about = check.function, check.name, check.title, check.kind
    return Result(module, *about, status, earned, check.points, **more)
