"""A check that broke is marked wherever its result is shown, and how it broke is shown to no student."""

import csv
import json
from dataclasses import replace
from io import StringIO
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from course.school.grading.checks.result import Status
from course.school.grading.classes.job import Graded, report_files
from course.school.grading.classes.keeping import keep, kept
from course.school.grading.classes.settings import INSTRUCTOR
from course.school.grading.report import Report
from course.school.grading.reports.classes import write_class_page, write_grades
from course.school.grading.reports.formats import as_json, as_xml, gradescope, prairielearn
from course.school.grading.reports.page import as_page

SECRET = "Traceback\n  the check's own lines"


@pytest.fixture
def broken(report: Report) -> Report:
    """One check that broke with the reference as well, and one that broke on what came back."""
    first, second, *others = report.results
    paid = replace(first, status=Status.GRADER_ERROR, points=1.0)
    failed = replace(second, mistake="", says="", found="it returned None")
    results = tuple(replace(one, broken=True, instructor=SECRET) for one in (paid, failed))
    others = [one for one in others if one.status is not Status.GRADER_ERROR]
    return replace(report, results=(*results, *others))


@pytest.fixture
def ids(broken: Report) -> list[str]:
    return [result.id for result in broken.broken]


def test_whoever_breaks_is_counted_whatever_it_paid(ids: list[str]) -> None:
    assert ids == ["thin_lens.lens_rays/contract", "thin_lens.lens_rays/focus"]


def test_no_student_sees_how_it_broke(broken: Report) -> None:
    files = report_files(broken)
    assert len(files) == 5
    for content in files.values():
        assert b"own lines" not in content
    assert "own lines" not in json.dumps(as_json(broken))


def test_gradescope_shows_no_check_as_passed_that_broke(broken: Report, ids: list[str]) -> None:
    document = gradescope(broken)
    assert document["output"].endswith("2 checks broke: whoever graded this has been told.")
    tests = {test["extra_data"]["id"]: test for test in document["tests"]}
    assert [tests[name]["status"] for name in ids] == ["failed", "failed"]
    assert [tests[name]["score"] for name in ids] == [1.0, 0.0]
    first, second = (tests[name]["output"].splitlines()[0] for name in ids)
    assert (first, second) == ("grader error, the check broke", "failed, the check broke")


def test_prairielearn_and_json_mark_it(broken: Report, ids: list[str]) -> None:
    document = prairielearn(broken)
    assert "2 checks broke" in document["message"]
    messages = {test["name"]: test["message"] for test in document["tests"]}
    assert [name for name in messages if "the check broke" in messages[name]] == ids
    assert [one["id"] for one in as_json(broken)["results"] if one["broken"]] == ids


def test_junit_has_errors_of_it_that_add_up(broken: Report) -> None:
    suite = ET.fromstring(as_xml(broken)).findall("testsuite")[0]
    found = [error.get("type") for error in suite.iter("error")]
    assert found == ["grader error, the check broke", "failed, the check broke", "timeout"]
    assert suite.get("errors") == "3"
    assert int(str(suite.get("failures"))) == len([*suite.iter("failure")])


def test_pages_and_grades_mark_it(broken: Report, ids: list[str], tmp_path: Path) -> None:
    assert as_page(broken).count(", the check broke</span>") == 2
    right = replace(broken, student="bob", results=broken.results[2:])
    write_class_page([broken, right], [], tmp_path / "class.html")
    page = (tmp_path / "class.html").read_text(encoding="utf-8")
    section = page.partition("Checks that broke</h2>")[2].partition("</section>")[0]
    assert [section.count(name) for name in ids] == [1, 1]
    assert "bob" not in section
    write_grades([broken, right], tmp_path / "grades.csv")
    text = (tmp_path / "grades.csv").read_text(encoding="utf-8")
    rows = {row["student"]: row for row in csv.DictReader(StringIO(text))}
    assert rows["ada"]["broken checks"].split() == ids
    assert rows["bob"]["broken checks"] == ""


def test_a_report_without_such_checks_says_nothing_of_them(report: Report, tmp_path: Path) -> None:
    whole = replace(
        report, results=tuple(r for r in report.results if r.status is not Status.GRADER_ERROR)
    )
    write_class_page([whole], [], tmp_path / "class.html")
    assert "broke" not in (tmp_path / "class.html").read_text(encoding="utf-8")
    for shown in (gradescope(whole), prairielearn(whole)):
        assert "broke" not in json.dumps(shown)


def test_what_was_kept_is_found_again_and_the_instructor_reads_how_it_broke(
    broken: Report, ids: list[str], tmp_path: Path
) -> None:
    keep(tmp_path, Graded(broken, report_files(broken)), "mark")
    found = kept(tmp_path, broken.student, "mark")
    assert found is not None
    assert [one.id for one in found.broken] == ids
    record = json.loads((tmp_path / INSTRUCTOR / "records" / "ada.json").read_bytes())
    assert record["broken"] == dict.fromkeys(ids, SECRET)
    for file in (tmp_path / broken.student).iterdir():
        assert b"own lines" not in file.read_bytes()
