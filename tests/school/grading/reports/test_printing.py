"""What is printed below the results of checks."""

from types import SimpleNamespace
from typing import Any

import pytest

from course.school.grading.checks.result import Status
from course.school.grading.reports.printing import FEW_POINTS, Printer


@pytest.mark.parametrize(
    ("passed", "points", "told"), [(10, 1.5, True), (10, 9.0, False), (4, 1.0, False)]
)
def test_few_points_for_many_checks_are_explained(
    capsys: pytest.CaptureFixture[str], passed: int, points: float, told: bool
) -> None:
    statuses = [Status.PASSED] * passed + [Status.FAILED] * (13 - passed)
    results = [SimpleNamespace(status=status) for status in statuses]
    report: Any = SimpleNamespace(results=results, printed={}, points=points, of=10, seconds=1.0)
    Printer(lambda _module, _function: "", None, 1).end(report)
    printed = capsys.readouterr().out
    assert f"{points:g} of 10 points, {passed} of 13 checks passed" in printed
    assert (FEW_POINTS in printed) == told
