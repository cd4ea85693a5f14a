"""The YAML file of a policy, read and checked; a mistake is told by file, line and key."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

from course.errors import CourseError
from course.formats.yaml.checking import convert
from course.formats.yaml.document import Document, KeyPath, show, suggest
from course.formats.yaml.tree import read_document
from course.grading.classes.names import same_name
from course.grading.classes.policy import Policy, Student
from course.inputs import LARGEST_SCENE, Bound, read_input, shown

MODIFIED = "modified"
"""What ``times`` says for the times of the files themselves."""

_TIME = "a date and time with its zone, such as 2026-10-01T23:59:00+02:00"


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
        wanted = {same_name(name) for name in names}
        for key, student in self.policy.students.items():
            if same_name(key) in wanted:
                return key, student
        return "", Student()

    def handed(self, names: Sequence[str]) -> Handed:
        """What the CSV file says of whoever goes by one of these names."""
        wanted = {same_name(name) for name in names}
        found = (handed for name, handed in self.times.items() if same_name(name) in wanted)
        return next(found, Handed())


def read_policy(path: Path, modules: Sequence[str]) -> Rules:
    """Read a policy.

    Parameters
    ----------
    modules : that are graded

    Raises
    ------
    CourseError
        For the first mistake, with file, line and key.
    """
    document = read_document(path, "policy")
    policy = convert(document, Policy)
    _check_modules(policy, document, modules)
    _check_sense(policy, document)
    students = policy.students
    own_deadlines = {
        name: _time(document, ("students", name, "deadline"), one.deadline)
        for name, one in students.items()
        if one.deadline is not None
    }
    own_times = {
        name: _time(document, ("students", name, "submitted"), one.submitted)
        for name, one in students.items()
        if one.submitted is not None
    }
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
    try:
        time = datetime.fromisoformat(text)
    except ValueError:
        time = None
    if time is None or time.tzinfo is None:
        raise document.unexpected(path, _TIME)
    return time


def _read_times(path: Path) -> dict[str, Handed]:
    try:
        text = read_input(path, "table of times", Bound(LARGEST_SCENE)).decode("utf-8-sig")
        rows = csv.DictReader(io.StringIO(text, newline=""))
        if not {"student", "submitted"} <= {*(rows.fieldnames or ())}:
            raise CourseError(f"{path}:1: expected the columns student and submitted")
        return {row["student"]: _handed(row, f"{path}:{rows.line_num}") for row in rows}
    except (UnicodeError, csv.Error) as error:
        raise CourseError(f"{shown(path)}: can't be read: {error}") from None


def _handed(row: Mapping[str, str | None], where: str) -> Handed:
    text, number = (row.get("submitted") or "").strip(), (row.get("attempts") or "").strip()
    try:
        submitted = datetime.fromisoformat(text) if text else None
    except ValueError:
        submitted = None
    if text and (submitted is None or submitted.tzinfo is None):
        raise CourseError(f"{where}: submitted is {show(text)}: expected {_TIME}")
    # Python makes no number of thousands of digits.
    if number and not (number.isdecimal() and len(number) < 10):
        raise CourseError(f"{where}: attempts is {show(number)}: expected a whole number >= 0")
    return Handed(submitted, int(number) if number else None)
