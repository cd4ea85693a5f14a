"""What makes a grade of points: one small YAML file of weights, late days, attempts and exceptions."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec

from course.formats.yaml.description import about

_Percent = Annotated[float, msgspec.Meta(ge=0, le=100)]
_NotNegative = Annotated[float, msgspec.Meta(ge=0)]
_Count = Annotated[int, msgspec.Meta(ge=0)]


class Late(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What coming late costs.

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
    """What more attempts than are free cost: so many percent of what was earned each, so many at most."""

    free: _Count
    percent_each: _Percent
    most_percent: _Percent = 100.0


class Rounding(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """To which multiples the final score is rounded, and in which direction."""

    step: Annotated[float, about("the final score is a multiple of it", gt=0)]
    direction: Literal["nearest", "up", "down"] = "nearest"


class Student(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What holds for one student.

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
    """What makes a grade.

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
