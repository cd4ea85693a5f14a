"""The time that calls which never end may take: bounded together, and kept for functions that do end."""

import contextlib
from itertools import product

import pytest

from course.school.grading.errors import StudentError
from course.school.grading.worker.limits import ALTOGETHER, LEAST, NOT_RUN, TimeBudget


@pytest.mark.parametrize("answered", list(product((False, True), repeat=6)))
def test_whoever_hangs_all_together_take_a_limited_time(answered: tuple[bool, ...]) -> None:
    time_budget = TimeBudget(10.0)
    lost = [0.0]
    for each in answered * 2:
        with contextlib.suppress(StudentError):
            lost.append(time_budget.limit(each))
            time_budget.lose(lost[-1])
    assert sum(lost) <= ALTOGETHER * 10
    assert min(lost[1:]) >= LEAST * 10
    assert max(lost) <= 10
    with pytest.raises(StudentError, match=NOT_RUN) as error:
        time_budget.limit(answered=False)
    assert error.value.kind == "timeout"


def test_one_hang_leaves_nearly_everything_to_functions_that_answer() -> None:
    time_budget = TimeBudget(10.0)
    time_budget.lose(time_budget.limit(answered=False))
    assert time_budget.limit(answered=True) == pytest.approx(8.4375)
    assert time_budget.limit(answered=False) == pytest.approx(2.8125)


def test_two_that_hang_late_leave_enough_for_the_first_calls_of_others() -> None:
    time_budget = TimeBudget(10.0)
    for _ in range(2):
        time_budget.lose(time_budget.limit(answered=True))
    assert time_budget.limit(answered=False) == pytest.approx(0.5)


def test_time_that_is_not_lost_costs_nothing() -> None:
    time_budget = TimeBudget(10.0)
    assert {time_budget.limit(answered=True) for _ in range(1000)} == {10.0}
    assert str(time_budget) == ""


def test_the_first_call_of_a_lone_check_may_be_a_large_one() -> None:
    assert TimeBudget(10.0, small_first=False).limit(answered=False) == 10.0
