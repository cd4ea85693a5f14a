"""What follows a failed check costs no more than its bounds, whatever the function gives."""

import gc
import tracemalloc
from typing import Any

import numpy as np
import pytest

from course.school.grading.catalog import module_checks
from course.school.grading.checks import bounds
from course.school.grading.checks.bounds import Bounded
from course.school.grading.checks.check import Check
from course.school.grading.checks.closer import NO_CLOSER_LOOK
from course.school.grading.checks.result import Status
from course.school.grading.checks.running import run_checks
from course.school.grading.errors import StudentError
from course.school.grading.looked import Looked
from course.school.grading.references import references

MEGABYTES = 12


def one(check: Check) -> bool:
    """The first check of one function."""
    return (check.function, check.name) == ("jitter_in_ball", "contract")


class Gives:
    """A ``Caller`` all of whose functions give as much."""

    def __init__(self, megabytes: int) -> None:
        self.asked, self._size = 0, megabytes << 18

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        self.asked += 1
        return np.zeros(self._size, np.float32)

    def call_and_look(self, function: str, *arguments: Any) -> Looked:
        return self.call(function), list(arguments), frozenset()


def test_calls_end_where_their_values_are_too_much() -> None:
    gives = Gives(MEGABYTES)
    bounded = Bounded(gives)
    for _ in range((bounds.MOST_BYTES >> 20) // MEGABYTES):
        bounded.call_and_look("f")
    with pytest.raises(StudentError):
        bounded.call_and_look("f")
    assert "MB" in bounded.over


def test_calls_end_where_they_take_too_long(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 0.0
    monkeypatch.setattr(bounds, "monotonic", lambda: now)
    bounded = Bounded(Gives(0))
    now = bounds.MOST_SECONDS - 1
    bounded.call("f")
    now = bounds.MOST_SECONDS + 1
    with pytest.raises(StudentError):
        bounded.call("f")
    assert " s " in bounded.over


def test_large_values_take_no_memory_where_a_mistake_is_looked_for() -> None:
    # Its three rows of u are tried in 48 orders and senses, and what came of each is kept.
    checks, gives = module_checks("glossy"), Gives(MEGABYTES)
    tracemalloc.start()
    try:
        found = run_checks(checks, gives, references(), 0, one)
        (result,) = found
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 400 << 20
    assert result.status is Status.FAILED
    assert NO_CLOSER_LOOK.partition("{")[0] in result.hint


def test_errors_keep_nothing_of_what_functions_gave() -> None:
    """Not until Python looks for cycles either: 15 MB a check had come to a gigabyte before it did."""
    checks = module_checks("motion_blur")
    quick = [check for check in checks.checks if check.kind == "contract"]
    gc.collect()
    gc.disable()
    tracemalloc.start()
    try:
        failed = run_checks(checks, Gives(8), references(), 0, lambda check: check in quick)
        statuses = [each.status for each in failed]
        held = tracemalloc.get_traced_memory()[0]
    finally:
        tracemalloc.stop()
        gc.enable()
    assert statuses.count(Status.FAILED) > 8
    assert held < 60 << 20
