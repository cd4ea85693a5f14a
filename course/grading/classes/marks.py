"""A student's score by a policy: raw, after what lateness and attempts cost, and rounded."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta

from course.grading.classes.policy import Policy, Rounding, Student
from course.grading.classes.policy_file import Handed, Rules
from course.grading.report import Report
from course.grading.reports.grouping import grouped

_DAY = timedelta(days=1)
_ROUND: dict[str, Callable[[float], int]] = {
    "nearest": lambda steps: math.floor(steps + 0.5),
    "up": math.ceil,
    "down": math.floor,
}


@dataclass(frozen=True)
class Mark:
    """A score, out of the policy's total.

    Attributes
    ----------
    raw : of the points by the modules' weights
    adjusted : with what lateness and attempts cost
    final : with what was added, rounded
    why : what makes the adjusted score another than the raw one
    """

    raw: float
    adjusted: float
    final: float
    why: tuple[str, ...] = ()


def mark(
    report: Report, rules: Rules, names: Sequence[str], modified: datetime | None = None
) -> Mark | None:
    """The score of a report by the rules; None for a submission that could not be graded.

    Parameters
    ----------
    names : that the student goes by
    modified : when the newest file of the submission was written; for policies that go by it
    """
    if report.trouble:
        return None
    policy = rules.policy
    key, student = rules.student(names)
    raw = policy.total * _share(report, policy, student)
    known = rules.handed(names)
    submitted = rules.own_times.get(key) or known.submitted or modified
    attempts = student.attempts if student.attempts is not None else known.attempts
    why: list[str] = []
    kept = _kept_late(rules, key, student, submitted, why)
    kept *= _kept_attempts(policy, Handed(submitted, attempts), why)
    adjusted = raw * kept
    if student.add:
        why.append(f"{student.add:+g}")
    final = _rounded(max(0.0, adjusted + student.add), policy.rounding)
    return Mark(raw, adjusted, final, tuple(why))


def _share(report: Report, policy: Policy, student: Student) -> float:
    """Share from 0 to 1 of what the modules that count can earn."""
    left_out = {*policy.drop, *student.excused}
    counting = [module for module in grouped(report) if module.name not in left_out and module.of]
    counting.sort(key=lambda module: module.points / module.of)
    counting = counting[policy.drop_lowest :]
    # With weights the check of all modules together counts for none of them.
    weighed = [
        (policy.weights.get(module.name, 0.0) if policy.weights else module.of, module)
        for module in counting
    ]
    whole = sum(weight for weight, _ in weighed)
    earned = sum(weight * module.points / module.of for weight, module in weighed)
    return earned / whole if whole else 0.0


def _kept_late(
    rules: Rules, key: str, student: Student, submitted: datetime | None, why: list[str]
) -> float:
    """Share that is kept of what was earned, for coming late."""
    late = rules.policy.late
    if late is None:
        return 1.0
    days = student.days_late
    if days is None:
        deadline = rules.own_deadlines.get(key) or rules.deadline
        if deadline is None:
            return 1.0
        if submitted is None:
            why.append("nobody knows when it was handed in: taken as in time")
            return 1.0
        extension = timedelta(days=student.extension_days, minutes=late.grace_minutes)
        days = max(0, math.ceil((submitted - deadline - extension) / _DAY))
    if not days:
        return 1.0
    if late.closed_after_days is not None and days > late.closed_after_days:
        why.append(f"{_days(days)} late: closed")
        return 0.0
    percent = min(late.most_percent, late.percent_per_day * max(0, days - late.free_days))
    why.append(f"{_days(days)} late: -{percent:g} %")
    return 1.0 - percent / 100.0


def _kept_attempts(policy: Policy, handed: Handed, why: list[str]) -> float:
    """Share that is kept of what was earned, for handing in more often than is free."""
    if policy.attempts is None or handed.attempts is None:
        return 1.0
    over = max(0, handed.attempts - policy.attempts.free)
    if not over:
        return 1.0
    percent = min(policy.attempts.most_percent, policy.attempts.percent_each * over)
    why.append(f"{handed.attempts} attempts: -{percent:g} %")
    return 1.0 - percent / 100.0


def _rounded(score: float, rounding: Rounding | None) -> float:
    if rounding is None:
        return score
    # A score that is a multiple but for the last bits is one: 0.1 has none of its own.
    steps = round(score / rounding.step, 9)
    return round(_ROUND[rounding.direction](steps) * rounding.step, 9)


def _days(days: int) -> str:
    return f"{days} day{'' if days == 1 else 's'}"
