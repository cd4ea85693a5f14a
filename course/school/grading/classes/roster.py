"""The list of a class, as Canvas, Moodle or the instructor writes it, and whose submission is whose."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from course.base.errors import CourseError
from course.base.inputs import shown
from course.base.texts import clean_line
from course.school.grading.classes.headings import (
    EMAIL,
    FIRST,
    GITHUB,
    GRADE,
    LAST,
    LOGIN,
    NAME,
    NUMBER,
    is_participant,
    meanings,
    squashed,
)
from course.school.grading.classes.systems import BY_GITHUB
from course.school.grading.classes.tables import ClassTable, read_table

_POINTS_POSSIBLE = "points possible"
"""What Canvas writes as the first student of its gradebook."""

_MOST_LISTED = 8
"""Columns that are named where they are passed over."""


@dataclass(frozen=True)
class Listed:
    """One student of a roster.

    Attributes
    ----------
    name : as the roster writes it, fit to be printed
    row : column -> text, as in the file
    keys : by which a submission may name the student, the surest first
    cells : the row as it stands
    """

    name: str
    row: Mapping[str, str]
    keys: tuple[frozenset[str], ...]
    cells: tuple[str, ...] = ()

    def get(self, *columns: str) -> str:
        """The text of the first of these columns that says something."""
        folded = {_folded(column): text for column, text in self.row.items()}
        return next((folded[column] for column in columns if folded.get(column)), "")


@dataclass(frozen=True)
class Worksheet:
    """A grading worksheet of Moodle.

    Attributes
    ----------
    grade : place of the column of grades
    most : the highest grade; None if it doesn't say
    comma : whether its numbers have a comma in the place of the point
    """

    grade: int
    most: float | None = None
    comma: bool = False


@dataclass(frozen=True)
class Roster:
    """The list of a class.

    Attributes
    ----------
    students : of the class, in the order of the file
    columns : headings, as they came
    is_canvas : whether it is the export of Canvas's gradebook
    worksheet : how Moodle's grading worksheet is to be filled in; None if it isn't one
    told : what was passed over
    """

    students: tuple[Listed, ...]
    columns: tuple[str, ...] = ()
    is_canvas: bool = False
    worksheet: Worksheet | None = None
    told: tuple[str, ...] = ()


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


def read_roster(path: Path) -> Roster:
    """Students of a CSV file with a heading: names, or first and last names, and logins, numbers or addresses.

    Headings may be in any of twenty languages; what isn't understood is told. Raises CourseError: the file can't be
    read, or has no column that names anybody.
    """
    table = read_table(path, "roster")
    means = meanings(table)
    if not {*means} - {"", GRADE}:
        listed = ", ".join(map(clean_line, table.columns[:_MOST_LISTED])) or "none"
        raise CourseError(
            f"{shown(path)}:1: no column names students: expected one such as Student, Name, Login, ID or Email; "
            f"found {listed}"
        )
    students = []
    told = _passed_over(table, means)
    for line, cells in table.rows:
        row = dict(reversed([*zip(table.columns, cells, strict=True)]))
        if _folded(cells[0]) == _POINTS_POSSIBLE:
            continue
        one = _listed(row, means, cells)
        if one is None:
            told.append(f"line {line} names nobody: {clean_line(' '.join(cells).strip())[:60]}")
        else:
            students.append(one)
    is_canvas = {"student", "id", "section"} <= {*map(_folded, table.columns)}
    told = [f"{shown(path)}: {one}" for one in told]
    return Roster(tuple(students), table.columns, is_canvas, _worksheet(table, means), tuple(told))


def _passed_over(table: ClassTable, means: Sequence[str]) -> list[str]:
    """The columns by which nobody is looked for."""
    over = [
        clean_line(column) or "(no heading)"
        for column, meaning in zip(table.columns, means, strict=True)
        if meaning in ("", GRADE)
    ]
    if not over:
        return []
    more = f" and {len(over) - _MOST_LISTED} more" if len(over) > _MOST_LISTED else ""
    return [f"nobody is looked for by the columns {', '.join(over[:_MOST_LISTED])}{more}"]


def _worksheet(table: ClassTable, means: Sequence[str]) -> Worksheet | None:
    columns = [[cells[i] for _, cells in table.rows] for i in range(len(table.columns))]
    if not any(map(is_participant, columns)):
        return None
    # In a language that isn't known: left of the highest grade, the same number in every row.
    numbers = [_number_of(column) for column in columns]
    grades = [i for i, meaning in enumerate(means) if meaning == GRADE]
    grades += [
        i - 1 for i, most in enumerate(numbers) if i > 0 and most is not None and not means[i - 1]
    ]
    if not grades:
        return None
    grade = grades[0]
    most = numbers[grade + 1] if grade + 1 < len(columns) else None
    comma = most is not None and "," in columns[grade + 1][0]
    return Worksheet(grade, most, comma)


def _number_of(column: Sequence[str]) -> float | None:
    """The positive number that stands in every row of a column."""
    try:
        (text,) = {*column}
        number = float(text.replace(",", "."))
    except ValueError:
        return None
    return number if 0.0 < number < 1e9 else None


def match(
    students: Sequence[Listed], submissions: Mapping[str, Sequence[Sequence[str]]]
) -> Matched:
    """Find whose submission each is: by numbers first, then by logins, then by names.

    ``submissions``: the name of each -> what may be its student's number, what the login, and what the name
    """
    found: dict[str, int] = {}
    # A login is a word as it is written; names are written in many ways.
    for level, read in enumerate((_folded, _folded, squashed)):
        owners: dict[str, set[int]] = {}
        for number, one in enumerate(students):
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
        for number, named_so in claims.items():
            if len(named_so) == 1 and number not in taken:
                found[named_so[0]] = number
    known = {*found.values()}
    return Matched(
        {student: students[number] for student, number in found.items()},
        tuple(one.name for i, one in enumerate(students) if i not in known),
        tuple(student for student in submissions if student not in found),
    )


def _listed(row: Mapping[str, str], means: Sequence[str], cells: tuple[str, ...]) -> Listed | None:
    by: dict[str, list[str]] = {}
    for meaning, text in zip(means, cells, strict=True):
        if text:
            by.setdefault(meaning, []).append(text)
    whole, first, last = (next(iter(by.get(meaning, ())), "") for meaning in (NAME, FIRST, LAST))
    # Canvas writes `Lee, Ann`.
    behind, comma, before = whole.partition(",")
    if comma:
        first, last = first or before.strip(), last or behind.strip()
    name = whole or f"{first} {last}".strip()
    # Brightspace writes #12345, lest a spreadsheet take it for a number.
    numbers = [number.removeprefix("#") for number in by.get(NUMBER, ())]
    # A worksheet of Moodle says `Participant 12345`, its downloads only the number.
    numbers += [number.split()[-1] for number in numbers if " " in number]
    mails = by.get(EMAIL, [])
    logins = [login.removeprefix("#") for login in by.get(LOGIN, ())]
    logins += [*mails, *(mail.partition("@")[0] for mail in [*mails, *logins] if "@" in mail)]
    github = [f"{BY_GITHUB}{login}" for login in by.get(GITHUB, ())]
    names = [name, f"{first}{last}", f"{last}{first}"]
    keys = (
        frozenset(filter(None, map(_folded, numbers))),
        frozenset(filter(None, map(_folded, [*logins, *github]))),
        frozenset(filter(None, map(squashed, names))),
    )
    told = name or next(iter([*logins, *by.get(GITHUB, ()), *numbers]), "")
    return Listed(clean_line(told), row, keys, cells) if told else None


def _folded(column: str) -> str:
    return " ".join(column.strip().casefold().split())
