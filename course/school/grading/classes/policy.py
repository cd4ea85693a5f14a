"""Grades from points, by one small YAML file of weights, late days, attempts and exceptions.

A mistake in it is told by file, line and key. A student's score by it is raw, after what lateness and attempts cost,
and rounded.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from pathlib import Path
from typing import Annotated, Literal, TypeVar

import msgspec

from course.base.errors import CourseError
from course.engine.formats.yaml.checking import convert
from course.engine.formats.yaml.description import about
from course.engine.formats.yaml.document import Document, KeyPath, show
from course.engine.formats.yaml.suggestions import suggest
from course.engine.formats.yaml.tree import read_document
from course.school.grading.classes.names import same_name
from course.school.grading.classes.tables import read_table
from course.school.grading.report import Report, grouped

MODIFIED = "modified"
"""What ``times`` says for the times of the files themselves."""

_TIME = "a date and time with its zone, such as 2026-10-01T23:59:00+02:00"

_DAY = timedelta(days=1)
_ROUND: dict[str, Callable[[float], int]] = {
    "nearest": lambda steps: math.floor(steps + 0.5),
    "up": math.ceil,
    "down": math.floor,
}
_Entry = TypeVar("_Entry")
_Percent = Annotated[float, msgspec.Meta(ge=0, le=100)]
_NotNegative = Annotated[float, msgspec.Meta(ge=0)]
_Count = Annotated[int, msgspec.Meta(ge=0)]


class Late(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The cost of coming late.

    Attributes
    ----------
    percent_per_day : taken off what was earned, for each day that has begun
    grace_minutes : after the deadline, that count as in time
    free_days : late days of each student that cost nothing
    most_percent : that are taken off at most
    closed_after_days : days after which nothing is earned
    """

    percent_per_day: _Percent
    grace_minutes: _NotNegative = 0.0
    free_days: _Count = 0
    most_percent: _Percent = 100.0
    closed_after_days: _Count | None = None


class Attempts(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The cost of more attempts than are free: so many percent of what was earned each, so many at most."""

    free: _Count
    percent_each: _Percent
    most_percent: _Percent = 100.0


class Rounding(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """To which multiples the final score is rounded, and in which direction."""

    step: Annotated[float, about("the final score is a multiple of it", gt=0)]
    direction: Literal["nearest", "up", "down"] = "nearest"


class Student(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Exceptions for one student.

    Attributes
    ----------
    submitted : when, with the zone
    attempts : how many
    days_late : instead of what the times say
    deadline : instead of everybody's
    extension_days : added to the deadline
    excused : modules that don't count
    add : to the final score, before it is rounded; negative to take off
    """

    submitted: str | None = None
    attempts: _Count | None = None
    days_late: _Count | None = None
    deadline: str | None = None
    extension_days: _NotNegative = 0.0
    excused: tuple[str, ...] = ()
    add: float = 0.0


class Policy(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Rules that make a grade of points.

    Attributes
    ----------
    total : the score of who has earned all points
    weights : module -> what share of the total it has, relative to the others; if there are none, modules count by
        their points
    drop : modules that don't count
    drop_lowest : how many modules don't count, those that a student did worst in
    deadline : with the zone, such as 2026-10-01T23:59:00+02:00
    times : "modified" for the times of the files, or a CSV file with the columns student, submitted and attempts
    late, attempts, rounding : see there; without them they change nothing
    students : name, login or number -> what holds for that student
    """

    total: Annotated[float, about("score of who has earned all points", gt=0)] = 100.0
    weights: dict[str, _NotNegative] = {}
    drop: tuple[str, ...] = ()
    drop_lowest: _Count = 0
    deadline: str | None = None
    times: str | None = None
    late: Late | None = None
    attempts: Attempts | None = None
    rounding: Rounding | None = None
    students: dict[str, Student] = {}


@dataclass(frozen=True)
class Handed:
    """When a student has handed in, and how often; None where nobody knows."""

    submitted: datetime | None = None
    attempts: int | None = None


@dataclass(frozen=True)
class Rules:
    """A checked policy.

    Attributes
    ----------
    policy : what the file says
    deadline : as a time
    own_deadlines, own_times : by the student, as the file's ``students`` name them
    times : of the CSV file, by the student
    """

    policy: Policy
    deadline: datetime | None = None
    own_deadlines: Mapping[str, datetime] = field(default_factory=dict)
    own_times: Mapping[str, datetime] = field(default_factory=dict)
    times: Mapping[str, Handed] = field(default_factory=dict)

    def student(self, names: Sequence[str]) -> tuple[str, Student]:
        """The name in the file of whoever goes by one of these names, and what holds for that student."""
        return _named(self.policy.students, names, ("", Student()))

    def handed(self, names: Sequence[str]) -> Handed:
        """The CSV file's entry of whoever goes by one of these names."""
        return _named(self.times, names, ("", Handed()))[1]


def _named(
    students: Mapping[str, _Entry], names: Sequence[str], otherwise: tuple[str, _Entry]
) -> tuple[str, _Entry]:
    wanted = {same_name(name) for name in names}
    return next((one for one in students.items() if same_name(one[0]) in wanted), otherwise)


def read_policy(path: Path, modules: Sequence[str]) -> Rules:
    """Read a policy.

    Raises CourseError for the first mistake, with file, line and key.
    ``modules``: that are graded
    """
    document = read_document(path, "policy")
    policy = convert(document, Policy)
    _check_modules(policy, document, modules)
    _check_sense(policy, document)
    own_deadlines, own_times = (
        {
            name: _time(document, ("students", name, key), text)
            for name, one in policy.students.items()
            if (text := getattr(one, key)) is not None
        }
        for key in ("deadline", "submitted")
    )
    deadline = policy.deadline and _time(document, ("deadline",), policy.deadline)
    from_file = policy.times not in (None, MODIFIED)
    times = _read_times(path.parent / str(policy.times)) if from_file else {}
    return Rules(policy, deadline or None, own_deadlines, own_times, times)


def _check_modules(policy: Policy, document: Document, modules: Sequence[str]) -> None:
    for path, name in _modules_named(policy):
        if name not in modules:
            raise document.error(path, f"{name} is not graded; {suggest(name, modules)}")
    left = [name for name in modules if name not in (*policy.weights, *policy.drop)]
    if policy.weights and left:
        raise document.error(
            ("weights",), f"{left[0]} is graded and has no weight: give it one, or drop it"
        )
    if policy.weights and not any(
        policy.weights[name] for name in {*policy.weights} - {*policy.drop}
    ):
        raise document.error(("weights",), "nothing counts: expected a weight > 0")


def _modules_named(policy: Policy) -> Iterator[tuple[KeyPath, str]]:
    for name in policy.weights:
        yield ("weights", name), name
    for i, name in enumerate(policy.drop):
        yield ("drop", i), name
    for key, student in policy.students.items():
        for i, name in enumerate(student.excused):
            yield ("students", key, "excused", i), name


def _check_sense(policy: Policy, document: Document) -> None:
    own = any(one.deadline or one.days_late is not None for one in policy.students.values())
    if policy.late is not None and policy.deadline is None and not own:
        raise document.error(("late",), "there is no deadline: expected a key deadline")
    if policy.deadline is not None and policy.late is None:
        raise document.error(("deadline",), "it changes nothing: expected a key late")


def _time(document: Document, path: KeyPath, text: str) -> datetime:
    time = _zoned(text)
    if time is None:
        raise document.unexpected(path, _TIME)
    return time


def _zoned(text: str) -> datetime | None:
    try:
        time = datetime.fromisoformat(text)
    except ValueError:
        return None
    return None if time.tzinfo is None else time


def _read_times(path: Path) -> dict[str, Handed]:
    table = read_table(path, "table of times")
    if not {"student", "submitted"} <= {*table.columns}:
        raise CourseError(f"{path}:1: expected the columns student and submitted")
    return {row["student"]: _handed(row, f"{path}:{line}") for line, row in table.records()}


def _handed(row: Mapping[str, str], where: str) -> Handed:
    text, number = row["submitted"], row.get("attempts", "")
    submitted = _zoned(text)
    if text and submitted is None:
        raise CourseError(f"{where}: submitted is {show(text)}: expected {_TIME}")
    # Python makes no number of thousands of digits.
    if number and not (number.isdecimal() and len(number) < 10):
        raise CourseError(f"{where}: attempts is {show(number)}: expected a whole number >= 0")
    return Handed(submitted, int(number) if number else None)


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
    kept *= _kept_attempts(policy, attempts, why)
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


def _kept_attempts(policy: Policy, attempts: int | None, why: list[str]) -> float:
    """Share that is kept of what was earned, for handing in more often than is free."""
    rule = policy.attempts
    if rule is None or attempts is None or attempts <= rule.free:
        return 1.0
    percent = min(rule.most_percent, rule.percent_each * (attempts - rule.free))
    why.append(f"{attempts} attempts: -{percent:g} %")
    return 1.0 - percent / 100.0


def _rounded(score: float, rounding: Rounding | None) -> float:
    if rounding is None:
        return score
    # A score that is a multiple but for the last bits is one: 0.1 has none of its own.
    steps = round(score / rounding.step, 9)
    return round(_ROUND[rounding.direction](steps) * rounding.step, 9)


def _days(days: int) -> str:
    return f"{days} day{'' if days == 1 else 's'}"
