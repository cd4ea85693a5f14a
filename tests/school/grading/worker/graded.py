"""What tests of workers grade: solutions, by the checks that render nothing and measure no time."""

from functools import cache

from course.engine.functions.effects import PROJECT
from course.school.grading.checks.check import Check, References
from course.school.grading.references import references


def solution(module: str) -> str:
    """The text of a reference solution."""
    return (PROJECT / "solutions" / f"{module}.py").read_text(encoding="utf-8")


def quick(check: Check) -> bool:
    """True for a check that is made at once."""
    return check.kind not in ("picture", "bias", "order", "speed")


@cache
def arrays() -> References:
    """What checks compare with, made once."""
    return references()
