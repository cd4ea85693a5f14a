"""What each check is worth: ten points a function, most of them for what a function of no use can't do.

So a function that is of no use earns at most a fifth, whatever conventions it keeps, and one that is wrong in a corner
keeps most of its points. The known submissions show both.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import replace

from course.grading.checks.check import Check, Role

POINTS = 10.0
"""Of a function."""

WHOLE = 40.0
"""Weight of a law that says all of a function's values: pictures, of weight 2, miss much that leaves it of no use."""

SHARES: dict[Role, float] = {"core": 0.8, "corner": 0.15, "convention": 0.05}
"""Of a function's points; without checks of a role its share goes to the core."""


def weighted(checks: Iterable[Check]) -> tuple[Check, ...]:
    """The same checks, their points shared out among those of a function and a role by their weights."""
    checks = tuple(checks)
    weights: dict[str, dict[Role, float]] = defaultdict(lambda: defaultdict(float))
    for check in checks:
        weights[check.function][check.role] += check.points
    return tuple(replace(check, points=_points(check, weights[check.function])) for check in checks)


def _points(check: Check, weights: dict[Role, float]) -> float:
    if not check.points:
        return 0.0
    shares = {role: SHARES[role] for role, weight in weights.items() if weight}
    share = shares[check.role]
    if check.role == "core":
        share = 1 - sum(other for role, other in shares.items() if role != "core")
    return POINTS * share * check.points / weights[check.role]
