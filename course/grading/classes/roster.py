"""The list of a class, as Canvas, Moodle or the instructor writes it, and whose submission is whose."""

import csv
import io
import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from course.errors import CourseError
from course.inputs import LARGEST_SCENE, Bound, read_input, shown

_NAMES = ("student", "name", "full name", "fullname")
_FIRST, _LAST = ("first name", "firstname", "given name"), ("last name", "lastname", "surname")
_NUMBERS = ("id", "identifier", "sis user id", "id number", "idnumber", "student id", "participant")
_LOGINS = ("sis login id", "login", "login id", "username", "user name", "netid", "email")
_EMAILS = ("email", "email address", "e-mail")

_POINTS_POSSIBLE = "points possible"
"""What Canvas writes as the first student of its gradebook."""


@dataclass(frozen=True)
class Listed:
    """One student of a roster.

    Attributes
    ----------
    name : as the roster writes it
    row : column -> text, as in the file
    keys : by which a submission may name the student, the surest first
    """

    name: str
    row: Mapping[str, str]
    keys: tuple[frozenset[str], ...]

    def get(self, *columns: str) -> str:
        """The text of the first of these columns that says something."""
        folded = {_folded(column): text for column, text in self.row.items()}
        return next((folded[column] for column in columns if folded.get(column)), "")


@dataclass(frozen=True)
class Matched:
    """Whose submission is whose.

    Attributes
    ----------
    students : by the submission's name
    without : students of the roster who have handed in nothing that is known to be theirs
    unknown : submissions of nobody in the roster, or of more than one
    """

    students: Mapping[str, Listed] = field(default_factory=dict)
    without: tuple[str, ...] = ()
    unknown: tuple[str, ...] = ()


def read_roster(path: Path) -> list[Listed]:
    """Students of a CSV file with a heading: names, or first and last names, and logins, numbers or addresses.

    Raises CourseError: the file can't be read, or has no column that names anybody.
    """
    columns, rows = read_table(path, "roster")
    known = {*_NAMES, *_FIRST, *_LAST, *_NUMBERS, *_LOGINS, *_EMAILS}
    if not known & {_folded(column) for column in columns}:
        raise CourseError(
            f"{path}:1: no column names students: expected one such as Student, Name, Login, ID or Email"
        )
    found = (_listed(row) for _, row in rows)
    return [one for one in found if one is not None]


def read_table(path: Path, what: str) -> tuple[list[str], list[tuple[int, dict[str, str]]]]:
    """Columns of a CSV file, and its rows with the numbers of their lines; ``CourseError`` where it can't be read."""
    try:
        text = read_input(path, what, Bound(LARGEST_SCENE)).decode("utf-8-sig")
        delimiter = max(",;\t", key=text.partition("\n")[0].count)
        rows = csv.DictReader(io.StringIO(text, newline=""), delimiter=delimiter)
        columns = [column for column in rows.fieldnames or () if column]
        return columns, [
            (rows.line_num, {column: (row.get(column) or "").strip() for column in columns})
            for row in rows
        ]
    except (UnicodeError, csv.Error) as error:
        raise CourseError(f"{shown(path)}: can't be read: {error}") from None


def match(roster: Sequence[Listed], submissions: Mapping[str, Sequence[Sequence[str]]]) -> Matched:
    """Find whose submission each is: by numbers first, then by logins, then by names.

    ``submissions``: the name of each -> what may be its student's number, what the login, and what the name
    """
    found: dict[str, int] = {}
    # A login is a word as it is written; names are written in many ways.
    for level, read in enumerate((_folded, _folded, _squashed)):
        owners: dict[str, set[int]] = {}
        for number, one in enumerate(roster):
            for key in one.keys[level]:
                owners.setdefault(key, set()).add(number)
        claims: dict[int, list[str]] = {}
        for student, texts in submissions.items():
            if student not in found:
                named = set[int]().union(*(owners.get(read(text), set()) for text in texts[level]))
                # Two of one name are for somebody else to tell apart.
                if len(named) == 1:
                    claims.setdefault(named.pop(), []).append(student)
        taken = {*found.values()}
        for number, students in claims.items():
            if len(students) == 1 and number not in taken:
                found[students[0]] = number
    return Matched(
        {student: roster[number] for student, number in found.items()},
        tuple(one.name for i, one in enumerate(roster) if i not in {*found.values()}),
        tuple(student for student in submissions if student not in found),
    )


def _listed(row: dict[str, str]) -> Listed | None:
    by = {_folded(column): text for column, text in row.items() if text}
    first, last = (next((by[c] for c in names if c in by), "") for names in (_FIRST, _LAST))
    whole = next((by[column] for column in _NAMES if column in by), "")
    if _folded(whole) == _POINTS_POSSIBLE:
        return None
    # Canvas writes `Lee, Ann`.
    behind, comma, before = whole.partition(",")
    if comma:
        first, last = first or before.strip(), last or behind.strip()
    name = whole or f"{first} {last}".strip()
    mail = [by[column].partition("@")[0] for column in _EMAILS if column in by]
    numbers = [by[column] for column in _NUMBERS if column in by]
    # A worksheet of Moodle says `Participant 12345`, its downloads only the number.
    numbers += [number.split()[-1] for number in numbers if " " in number]
    logins = [*(by[column] for column in _LOGINS if column in by), *mail]
    names = [name, f"{first}{last}", f"{last}{first}"]
    keys = (
        frozenset(filter(None, map(_folded, numbers))),
        frozenset(filter(None, map(_folded, logins))),
        frozenset(filter(None, map(_squashed, names))),
    )
    shown = name or next(iter([*logins, *numbers]), "")
    return Listed(shown, row, keys) if shown else None


def _folded(column: str) -> str:
    return " ".join(column.strip().casefold().split())


def _squashed(name: str) -> str:
    """A name without what systems write in different ways: accents, case, blanks and signs."""
    plain = unicodedata.normalize("NFKD", name).casefold()
    return re.sub(r"[\W_]", "", "".join(c for c in plain if not unicodedata.combining(c)))
