"""Reports for other programs: each has the keys, and the sums, that its reader expects."""

import csv
import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import jsonschema
import numpy as np
import pytest

from course.school.grading.checks.result import Status
from course.school.grading.classes.policy import Mark
from course.school.grading.report import Report
from course.school.grading.reports.classes import ClassLine, safe_cell, write_grades
from course.school.grading.reports.formats import (
    as_json,
    as_xml,
    gradescope,
    json_bytes,
    prairielearn,
)

TEXT = {"type": "string"}
NUMBER = {"type": "number"}


def exactly(**properties: Any) -> dict[str, Any]:
    """A schema of an object with these keys and no others."""
    return {
        "type": "object",
        "properties": properties,
        "required": list(properties),
        "additionalProperties": False,
    }


def listing(items: dict[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": items}


OURS = exactly(
    format={"const": 1},
    student=TEXT,
    version=TEXT,
    seed={"type": "integer"},
    seconds=NUMBER,
    score={"type": "number", "minimum": 0, "maximum": 1},
    points=NUMBER,
    of=NUMBER,
    trouble=TEXT,
    counts=exactly(**{str(status): {"type": "integer"} for status in Status}),
    protections=listing(TEXT),
    remarks=listing(TEXT),
    printed={"type": "object", "additionalProperties": TEXT},
    results=listing(
        exactly(
            **dict.fromkeys(
                ("id", "module", "function", "check", "title", "kind", "mistake", "says"), TEXT
            ),
            **dict.fromkeys(
                ("expected", "found", "where", "hint", "example", "reproduce", "docs"), TEXT
            ),
            same_as=TEXT,
            module_wide={"type": "boolean"},
            broken={"type": "boolean"},
            status={"enum": [str(status) for status in Status]},
            points=NUMBER,
            of=NUMBER,
            seconds=NUMBER,
        )
    ),
)
GRADESCOPE = exactly(
    score=NUMBER,
    execution_time=NUMBER,
    output=TEXT,
    output_format={"enum": ["text", "html", "simple_format", "md", "ansi"]},
    visibility={"enum": ["visible", "hidden", "after_due_date", "after_published"]},
    stdout_visibility={"enum": ["visible", "hidden", "after_due_date", "after_published"]},
    extra_data=exactly(version=TEXT),
    tests=listing(
        exactly(
            score=NUMBER,
            max_score=NUMBER,
            status={"enum": ["passed", "failed"]},
            name=TEXT,
            number={"type": "string", "pattern": r"^\d+\.\d+\.\d+$"},
            output=TEXT,
            output_format={"const": "text"},
            tags=listing(TEXT),
            visibility={"const": "visible"},
            extra_data={"type": "object"},
        )
    ),
)
PRAIRIELEARN = exactly(
    gradable={"type": "boolean"},
    format_errors=listing(TEXT),
    score={"type": "number", "minimum": 0, "maximum": 1},
    message=TEXT,
    output=TEXT,
    images=listing(exactly(label=TEXT, url={"type": "string", "pattern": "^data:image/"})),
    tests=listing(
        exactly(
            name=TEXT, description=TEXT, points=NUMBER, max_points=NUMBER, message=TEXT, output=TEXT
        )
    ),
)
FORMATS = [(as_json, OURS), (gradescope, GRADESCOPE), (prairielearn, PRAIRIELEARN)]


@pytest.mark.parametrize(("make", "schema"), FORMATS)
@pytest.mark.parametrize("which", ["report", "hostile_report", "nothing", "nan"])
def test_every_document_has_its_keys(
    make: Callable[[Report], dict[str, Any]],
    schema: dict[str, Any],
    which: str,
    request: pytest.FixtureRequest,
    report: Report,
) -> None:
    if which == "nothing":
        report = Report("ada", (), trouble="no zip file")
    elif which == "nan":
        odd = replace(report.results[0], points=math.nan, seconds=math.inf)
        report = replace(report, results=(odd,), seconds=math.nan)
    else:
        report = request.getfixturevalue(which)

    def refuse(constant: str) -> None:
        raise AssertionError(constant)

    document = json.loads(json_bytes(make(report)), parse_constant=refuse)
    jsonschema.validate(document, schema)


def test_json_holds_what_was_found(report: Report) -> None:
    document = json.loads(json_bytes(as_json(report)))
    assert document == as_json(report)
    assert document["points"] == sum(result["points"] for result in document["results"]) == 3
    assert document["of"] == 11.5
    assert sum(document["counts"].values()) == len(report.results)
    assert [result["id"] for result in document["results"]] == [r.id for r in report.results]
    focus = document["results"][1]
    assert focus["reproduce"] == "course check thin_lens --only lens_rays/focus --seed 7"
    assert focus["docs"] == "docs/modules/thin_lens.md#lens_rays"
    assert focus["says"] == "You focus on a sphere, not on a plane."


def test_gradescope_scores_add_up_and_nothing_is_left_out(report: Report) -> None:
    document = gradescope(report)
    tests = document["tests"]
    assert document["score"] == sum(test["score"] for test in tests) == 3
    assert sum(test["max_score"] for test in tests) == 11.5
    assert {test["extra_data"]["id"] for test in tests} == {result.id for result in report.results}
    assert len({test["number"] for test in tests}) == len(tests)
    (missing,) = [test for test in tests if "missing" in test["extra_data"]["id"]]
    assert missing["status"] == "failed"
    assert missing["score"] == 0
    assert missing["max_score"] == 3
    assert "not attempted" in missing["output"]
    status = {test["extra_data"]["status"]: test["status"] for test in tests}
    assert status == {
        "passed": "passed",
        "failed": "failed",
        "timeout": "failed",
        "crashed": "failed",
        "grader error": "failed",
        "not attempted": "failed",
    }
    (focus,) = [test for test in tests if "focus" in test["extra_data"]["id"]]
    for text in ("0.25 within", "0.75", "u = 0.5", "sphere", "--only lens_rays/focus"):
        assert text in focus["output"]


def test_systems_that_students_read_hide_a_seed_that_is_not_everybody_s(report: Report) -> None:
    assert report.seed == 7
    for results in (gradescope, prairielearn):
        shown = json.dumps(results(report))
        assert "seed" not in shown
        assert "course check thin_lens --only lens_rays/focus" in shown
        # That of everybody's copy is no secret.
        assert "--only lens_rays/focus --seed 0" in json.dumps(results(replace(report, seed=0)))


def test_prairielearn_scores_are_shares(report: Report) -> None:
    document = prairielearn(report)
    assert document["score"] == pytest.approx(3 / 11.5, abs=1e-6)
    tests = document["tests"]
    points = [sum(test[key] for test in tests) for key in ("points", "max_points")]
    assert points == [3, 11.5]
    assert document["gradable"]
    assert "hello from thin_lens" in document["output"]
    broken = prairielearn(Report("ada", (), trouble="no zip file"))
    assert not broken["gradable"]
    assert "no zip file" in broken["message"]
    assert broken["format_errors"] == ["no zip file"]


def test_prairielearn_texts_stay_below_its_limit(report: Report) -> None:
    long = replace(report.results[1], found="\u20ac" * 30_000)
    many = replace(report, results=(long,) * 600)
    document = prairielearn(many)
    assert len(json.dumps(document)) < 1_000_000
    assert sum(test["max_points"] for test in document["tests"]) == 600 * long.of
    # The line that finds it again is there for each.
    assert all("again: course check thin_lens" in test["output"] for test in document["tests"])


def test_prairielearn_images_stay_below_its_limit(with_figure: Callable[..., Report]) -> None:
    rng = np.random.default_rng(0)
    report = with_figure(
        "pictures", yours=rng.random((3, 36, 48)), expected=rng.random((3, 36, 48))
    )
    assert len(prairielearn(report)["images"]) == 5
    large = with_figure("pictures", yours=rng.random((3, 250, 250)))
    many = replace(large, results=large.results * 40)
    assert len(json.dumps(prairielearn(many))) < 1_000_000
    assert prairielearn(many)["images"]


def test_junit_counts_are_those_of_its_elements(report: Report) -> None:
    root = ET.fromstring(as_xml(report).encode())
    assert root.tag == "testsuites"
    suites = root.findall("testsuite")
    assert [suite.get("name") for suite in suites] == ["thin_lens", "glossy"]
    tags = {"tests": "testcase", "failures": "failure", "errors": "error", "skipped": "skipped"}
    for element in (root, *suites):
        for attribute, tag in tags.items():
            assert element.get(attribute) == str(len(list(element.iter(tag))))
    assert [root.get(name) for name in tags] == ["8", "2", "3", "1"]
    assert suites[0].findtext("system-out") == "hello from thin_lens"
    failure = next(root.iter("failure"))
    assert failure.get("message") == "You focus on a sphere, not on a plane."
    assert "--only lens_rays/focus --seed 7" in (failure.text or "")


def test_junit_of_hostile_texts_is_well_formed(hostile_report: Report) -> None:
    root = ET.fromstring(as_xml(hostile_report).encode("utf-8"))
    failure = next(root.iter("failure"))
    assert "<script>alert(1)</script>" in (failure.get("message") or "")
    assert {element.tag for element in root.iter()} <= {
        *("testsuites", "testsuite", "testcase", "properties", "property"),
        *("failure", "error", "skipped", "system-out"),
    }


def test_junit_says_why_nothing_was_graded() -> None:
    root = ET.fromstring(as_xml(Report("ada", (), trouble="no zip file")).encode("utf-8"))
    assert root.get("errors") == "1"
    assert [error.get("message") for error in root.iter("error")] == ["no zip file"]


def grades(reports: list[Report], folder: Path) -> list[dict[str, str]]:
    write_grades(reports, folder / "grades.csv")
    with (folder / "grades.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_grades_have_a_column_for_each_function(report: Report, tmp_path: Path) -> None:
    other = replace(report, student="bob", results=report.results[:2])
    broken = Report("eve", (), trouble="no zip file")
    rows = grades([report, other, broken], tmp_path)
    assert list(rows[0]) == [
        *("student", "score", "points", "of", "broken checks", "remarks"),
        *("thin_lens.lens_rays", "thin_lens.point_on_disk", "glossy.keep_above"),
        *("glossy.jitter_in_ball", "glossy.jitter_on_plane"),
    ]
    assert [row["student"] for row in rows] == ["ada", "bob", "eve"]
    assert [row["points"] for row in rows] == ["3", "1", ""]
    assert [row["of"] for row in rows] == ["11.5", "3.5", ""]
    assert [row["remarks"] for row in rows] == ["", "", "no zip file"]
    assert rows[0]["score"] == "0.26087"
    assert sum(float(value) for name, value in rows[0].items() if "." in name) == 3
    assert rows[1]["glossy.keep_above"] == ""


def test_grades_by_a_policy_and_remarks(report: Report, tmp_path: Path) -> None:
    broken = Report("eve", (), trouble="no zip file")
    lines = {
        "ada": ClassLine(("x was graded as y",), Mark(26.0, 20.8, 21.0, ("2 days late: -20 %",))),
        "eve": ClassLine(("=1+1",)),
    }
    write_grades([report, broken], tmp_path / "grades.csv", lines, 100.0)
    with (tmp_path / "grades.csv").open(encoding="utf-8", newline="") as file:
        ada, eve = csv.DictReader(file)
    assert [ada[name] for name in ("raw", "adjusted", "final")] == ["26", "20.8", "21"]
    assert ada["remarks"] == "2 days late: -20 %; x was graded as y"
    assert [eve[name] for name in ("score", "raw", "adjusted", "final")] == [""] * 4
    assert eve["remarks"] == "no zip file; '=1+1"


@pytest.mark.parametrize(
    "name",
    ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1+1", "\r=1+1", "\n=1", "  =1+1", "\x1b[0m=1", "\uff1d1"],
)
def test_no_name_becomes_a_formula(report: Report, tmp_path: Path, name: str) -> None:
    (row,) = grades([replace(report, student=name)], tmp_path)
    assert row["student"].startswith("'")
    assert row["points"] == "3"


def test_names_keep_their_letters(tmp_path: Path, report: Report, hostile: str) -> None:
    for name in ('Zoë, "Z" O\'Neil', "a\nb", "李"):
        (row,) = grades([replace(report, student=name)], tmp_path)
        assert row["student"] == name == safe_cell(name)
    (row,) = grades([replace(report, student=hostile)], tmp_path)
    assert "<script>" in row["student"]
    assert "\x00" not in row["student"]


def test_why_a_function_is_still_to_do_is_told(report: Report) -> None:
    (stub,) = (one for one in report.results if one.status is Status.NOT_ATTEMPTED)
    for found, message in (
        ("glossy.py has no f", "glossy.py has no f"),
        ("glossy.f: not written yet", "not attempted"),
    ):
        root = ET.fromstring(as_xml(replace(report, results=(replace(stub, found=found),))))
        assert [skipped.get("message") for skipped in root.iter("skipped")] == [message]
