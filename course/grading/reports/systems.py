"""Grades as Canvas and Moodle import them: a line for each student of the roster who has a grade."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from io import StringIO
from pathlib import Path

from course.atomic import write_text
from course.grading.classes.roster import Listed
from course.grading.reports.text import clean, finite

_CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
_MOODLE = ("Identifier", "Full name", "Username", "ID number", "Email address")


def write_canvas(
    grades: Sequence[tuple[Listed, float]], total: float, title: str, path: Path
) -> None:
    """Write a gradebook that Canvas imports: columns of the roster, and one of grades.

    Parameters
    ----------
    total : points of who has earned all
    title : the assignment as Canvas calls it, such as "Lens (12345)"; a new name makes a new assignment

    Raises
    ------
    OutputError
        The file can't be written.
    """
    rows = [["    Points Possible", "", "", "", "", _number(total)]]
    for listed, grade in grades:
        rows.append([*_row(listed, _CANVAS, {"Student": listed.name}), _number(grade)])
    _write([[*_CANVAS, clean(title)], *rows], path)


def write_moodle(grades: Sequence[tuple[Listed, float]], title: str, path: Path) -> None:
    """Write a table that Moodle imports, as an upload of a grading worksheet or into the gradebook.

    Raises
    ------
    OutputError
        The file can't be written.
    """
    rows = []
    for listed, grade in grades:
        own = {
            "Full name": listed.name,
            "Username": listed.get("username", "login", "sis login id", "netid"),
            "ID number": listed.get("id number", "idnumber", "student id", "sis user id"),
            "Email address": listed.get("email", "e-mail"),
        }
        rows.append([*_row(listed, _MOODLE, own), _number(grade)])
    _write([[*_MOODLE, clean(title)], *rows], path)


def _row(listed: Listed, columns: Sequence[str], otherwise: Mapping[str, str]) -> list[str]:
    """What the roster says in these columns: it is the system's own, so no text is changed that it knows by."""
    return [clean(listed.get(c.casefold()) or otherwise.get(c, "")) for c in columns]


def _number(value: float) -> str:
    return f"{finite(value):g}"


def _write(rows: Sequence[Sequence[str]], path: Path) -> None:
    buffer = StringIO()
    csv.writer(buffer, lineterminator="\n").writerows(rows)
    write_text(path, buffer.getvalue())
