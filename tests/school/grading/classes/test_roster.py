"""Whose submission is whose, and the tables that Canvas and Moodle import."""

import csv
from pathlib import Path

import pytest

from course.base.errors import CourseError
from course.school.grading.classes.roster import Matched, match, read_roster
from course.school.grading.classes.submitted import find_submissions
from course.school.grading.reports.classes import write_gradebook

CANVAS = """\
Student,ID,SIS User ID,SIS Login ID,Section,Old (1)
    Points Possible,,,,,10
"Lee, Ann",11,U11,alee,A,3
"Wu, Bo",12,U12,bwu,A,
"Müller, Zoë",13,U13,zmu,B,
"Wu, Bo",14,U14,bowu,B,
"""
MOODLE = """\
Identifier,Full name,Email address,Status,Grade
Participant 11,Ann Lee,ann@example.org,Submitted,-
Participant 12,Bo Wu,bo@example.org,Submitted,-
"""


def roster(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "roster.csv"
    path.write_text(text, encoding="utf-8-sig")
    return path


def matched_names(tmp_path: Path, text: str, submissions: dict[str, tuple[str, ...]]) -> Matched:
    claims = {student: (known,) * 3 for student, known in submissions.items()}
    return match(read_roster(roster(tmp_path, text)).students, claims)


def names(tmp_path: Path, text: str, **submissions: tuple[str, ...]) -> dict[str, str]:
    matched = matched_names(tmp_path, text, submissions)
    return {student: listed.name for student, listed in matched.students.items()}


def test_numbers_logins_and_names(tmp_path: Path) -> None:
    found = names(
        tmp_path, CANVAS, leeann_11=("leeann_11", "leeann", "11"), bwu=("bwu",), zoe=("Zoe Muller",)
    )
    assert found == {"leeann_11": "Lee, Ann", "bwu": "Wu, Bo", "zoe": "Müller, Zoë"}


@pytest.mark.parametrize("name", ["Ann Lee", "annlee", "LeeAnn", "Lee_Ann", "alee", "u11", "11"])
def test_each_way_to_say_who_it_is(tmp_path: Path, name: str) -> None:
    assert names(tmp_path, CANVAS, one=(name,)) == {"one": "Lee, Ann"}


def test_two_of_one_name_are_not_guessed(tmp_path: Path) -> None:
    matched = matched_names(tmp_path, CANVAS, {"Bo Wu": ("Bo Wu",), "eve": ("eve",)})
    assert not matched.students
    assert matched.unknown == ("Bo Wu", "eve")
    assert matched.without == ("Lee, Ann", "Wu, Bo", "Müller, Zoë", "Wu, Bo")


def test_two_submissions_of_one_student_are_not_guessed(tmp_path: Path) -> None:
    matched = matched_names(tmp_path, CANVAS, {"a": ("Ann Lee",), "b": ("lee ann",)})
    assert not matched.students
    assert matched.unknown == ("a", "b")
    # A number is surer than a name.
    matched = matched_names(tmp_path, CANVAS, {"a": ("11",), "b": ("lee ann",)})
    assert {*matched.students} == {"a"}


def test_downloads_of_moodle_are_found_by_participant_and_address(tmp_path: Path) -> None:
    found = names(tmp_path, MOODLE, first=("Somebody Else_11", "11"), second=("bo",))
    assert found == {"first": "Ann Lee", "second": "Bo Wu"}


@pytest.mark.parametrize("name", ["12", "bwu", "U12"])
def test_the_own_name_in_a_download_is_no_number_and_no_login(tmp_path: Path, name: str) -> None:
    """Where students may change their names, one could call himself by another's number or login."""
    (tmp_path / f"{name}_999_1_thin_lens.py").write_text("def thin_lens(): ...")
    submissions = find_submissions(tmp_path, ["thin_lens"])
    matched = match(
        read_roster(roster(tmp_path, CANVAS)).students,
        {one.student: one.claims for one in submissions},
    )
    assert not matched.students


def test_other_delimiters_and_separate_names(tmp_path: Path) -> None:
    text = "First name;Last name;Username\nAnn;Lee;alee\n"
    assert names(tmp_path, text, x=("Lee Ann",)) == {"x": "Ann Lee"}


@pytest.mark.parametrize(
    ("text", "told"),
    [("a,b\n1,2\n", ":1: no column names students"), ("", ":1: no column names students")],
)
def test_a_table_that_is_no_roster(tmp_path: Path, text: str, told: str) -> None:
    with pytest.raises(CourseError, match=told):
        read_roster(roster(tmp_path, text))


def test_what_canvas_imports(tmp_path: Path) -> None:
    own = read_roster(roster(tmp_path, CANVAS))
    grades = [(own.students[0], 87.5), (own.students[2], 0.0)]
    write_gradebook("canvas.csv", own, grades, 100.0, "Lens (77)", tmp_path / "c.csv")
    with (tmp_path / "c.csv").open(newline="", encoding="utf-8") as file:
        rows = [*csv.reader(file)]
    assert rows == [
        ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "Lens (77)"],
        ["    Points Possible", "", "", "", "", "100"],
        ["Lee, Ann", "11", "U11", "alee", "A", "87.5"],
        ["Müller, Zoë", "13", "U13", "zmu", "B", "0"],
    ]


def test_what_moodle_imports(tmp_path: Path) -> None:
    own = read_roster(roster(tmp_path, MOODLE))
    write_gradebook(
        "moodle.csv", own, [(own.students[1], 12.25)], 100.0, "Lens", tmp_path / "m.csv"
    )
    with (tmp_path / "m.csv").open(newline="", encoding="utf-8") as file:
        (row,) = csv.DictReader(file)
    assert row["Identifier"] == "Participant 12"
    assert (row["Full name"], row["Email address"]) == ("Bo Wu", "bo@example.org")
    assert row["Grade"] == "12.25"
