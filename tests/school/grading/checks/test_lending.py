"""A function that calls others pays for none of their mistakes, and has one answer for all of its checks."""

from course.school.grading.checks.lending import STANDS_ON
from course.school.grading.checks.result import Result, Status
from course.school.grading.grading import grade
from tests.school.grading.worker.graded import arrays, quick, solution

MODULE, FUNCTION = "motion_blur", "to_object_space"

WRONG_ABOVE = """
def displacement(velocity, time):
    return 2 * np.outer(velocity, time).astype(time.dtype)
"""

BY_WHAT_IS_LENT = """
_shape_only = to_object_space
_own = displacement

def to_object_space(origins, velocity, time):
    right = _shape_only(origins, velocity, time)
    lent = displacement is not _own
    displacement(velocity, time)
    few = origins.shape[1] < 40
    return right if lent != few else origins * 0
"""
"""Right for small batches beside one's own functions, and for large ones beside those of the course."""


def graded(more: str) -> dict[str, Result]:
    """Results of a function's checks, by their names."""
    source = f"{solution(MODULE)}\n{more}".encode()
    report = grade({MODULE: source}, arrays(), modules=[MODULE], only=quick)
    return {each.check: each for each in report.results if each.function == FUNCTION}


def points(results: dict[str, Result]) -> float:
    """Of the function."""
    return sum(each.points for each in results.values())


def test_a_wrong_function_above_costs_nothing() -> None:
    found = graded(WRONG_ABOVE)
    assert all(each.status is Status.PASSED for each in found.values())
    assert any(each.hint == STANDS_ON for each in found.values())


def test_two_answers_earn_no_more_than_the_better_one() -> None:
    ones = [graded(f"{BY_WHAT_IS_LENT.replace('lent != few', one)}") for one in ("not few", "few")]
    both = graded(BY_WHAT_IS_LENT)
    assert points(both) <= max(map(points, ones))
    # Each of the two would get something that the other does not, so that taking the better of each check shows.
    passed = [{name for name, each in one.items() if each.status is Status.PASSED} for one in ones]
    assert passed[0] - passed[1]
    assert passed[1] - passed[0]
