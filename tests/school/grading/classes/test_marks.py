"""Scores by a policy: what counts, what lateness and attempts cost, and mistakes told by file, line and key."""

from dataclasses import replace
from datetime import datetime
from pathlib import Path
from types import SimpleNamespace

import pytest

from course.base.errors import CourseError
from course.school.grading.checks.result import Result, Status
from course.school.grading.classes.grading import modified
from course.school.grading.classes.policy import Mark, mark, read_policy
from course.school.grading.classes.submitted import Submission
from course.school.grading.report import Report

MODULES = ("thin_lens", "glossy", "sampling")
DEADLINE = "deadline: 2026-10-01T23:59:00+02:00\n"
LATE = DEADLINE + "late: {percent_per_day: 10, grace_minutes: 15, most_percent: 40}\n"


def result(module: str, points: float, of: float) -> Result:
    return Result(module, "f", "c", "title", "property", Status.PASSED, points, of)


REPORT = Report(
    "ada", (result("thin_lens", 10, 20), result("glossy", 10, 10), result("sampling", 0, 10))
)


def score(tmp_path: Path, text: str, *, modified: str = "", report: Report = REPORT) -> Mark:
    (tmp_path / "policy.yaml").write_text(text)
    rules = read_policy(tmp_path / "policy.yaml", MODULES)
    time = datetime.fromisoformat(modified) if modified else None
    found = mark(report, rules, ("ada_17", "ada", "17"), time)
    assert found is not None
    return found


@pytest.mark.parametrize(
    ("text", "raw"),
    [
        ("total: 100", 50),
        ("total: 40", 20),
        ("weights: {thin_lens: 1, glossy: 1, sampling: 2}", 100 * (0.5 + 1) / 4),
        ("weights: {thin_lens: 1, glossy: 1}\ndrop: [sampling]", 75),
        ("drop: [sampling]", 100 * 20 / 30),
        ("drop_lowest: 1", 100 * 20 / 30),
        ("drop_lowest: 2", 100),
        ("students: {ada: {excused: [thin_lens, sampling]}}", 100),
        ("students: {ADA: {excused: [sampling]}}", 100 * 20 / 30),
    ],
)
def test_what_counts(tmp_path: Path, text: str, raw: float) -> None:
    assert score(tmp_path, text).raw == pytest.approx(raw)


@pytest.mark.parametrize(
    ("submitted", "percent"),
    [
        ("2026-10-01T23:59:00+02:00", 0),
        ("2026-10-02T00:14:00+02:00", 0),
        ("2026-10-02T00:14:01+02:00", 10),
        ("2026-10-03T00:14:00+02:00", 10),
        ("2026-10-03T00:15:00+02:00", 20),
        # The same moment elsewhere.
        ("2026-10-02T22:15:00+00:00", 20),
        ("2026-11-01T00:00:00+01:00", 40),
    ],
)
def test_days_late(tmp_path: Path, submitted: str, percent: float) -> None:
    found = score(tmp_path, LATE, modified=submitted)
    assert found.raw == 50
    assert found.adjusted == found.final == pytest.approx(50 * (1 - percent / 100))
    assert bool(found.why) == (percent > 0)


@pytest.mark.parametrize(
    ("more", "percent"),
    [
        ("students: {ada: {extension_days: 2}}", 0),
        ("students: {ada: {extension_days: 1}}", 10),
        ("students: {'17': {deadline: '2026-10-03T23:00:00+02:00'}}", 0),
        ("students: {ada: {submitted: '2026-10-01T12:00:00+02:00'}}", 0),
        ("students: {ada: {days_late: 3}}", 30),
        ("students: {bob: {extension_days: 9}}", 20),
    ],
)
def test_exceptions(tmp_path: Path, more: str, percent: float) -> None:
    found = score(tmp_path, LATE + more, modified="2026-10-03T12:00:00+02:00")
    assert found.adjusted == pytest.approx(50 * (1 - percent / 100))


def test_free_days_and_the_end(tmp_path: Path) -> None:
    text = DEADLINE + "late: {percent_per_day: 10, free_days: 2, closed_after_days: 3}\n"
    for day, percent in (("03", 0), ("04", 10), ("05", 100)):
        found = score(tmp_path, text, modified=f"2026-10-{day}T12:00:00+02:00")
        assert found.adjusted == pytest.approx(50 * (1 - percent / 100))


def test_a_time_that_nobody_knows_costs_nothing_and_is_told(tmp_path: Path) -> None:
    found = score(tmp_path, LATE)
    assert found.adjusted == 50
    assert "nobody knows when" in found.why[0]


def test_attempts_and_times_of_a_table(tmp_path: Path) -> None:
    (tmp_path / "times.csv").write_text(
        "student,submitted,attempts\nADA,2026-10-03T00:15:00+02:00,5\nbob,,\n"
    )
    text = LATE + "times: times.csv\nattempts: {free: 3, percent_each: 5}\n"
    found = score(tmp_path, text)
    assert found.adjusted == pytest.approx(50 * 0.8 * 0.9)
    assert found.why == ("2 days late: -20 %", "5 attempts: -10 %")


@pytest.mark.parametrize("seconds", [1e15, -1e15])
def test_a_file_may_have_any_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seconds: float
) -> None:
    """Archives give files the times that they like, and some file systems keep them."""
    monkeypatch.setattr(Path, "lstat", lambda _: SimpleNamespace(st_mtime=seconds))
    found = modified(Submission("ada", (tmp_path / "thin_lens.py",)))
    assert found is not None
    assert (found.year == 9999) == (seconds > 0)


@pytest.mark.parametrize(
    ("rounding", "final"),
    [
        ("{step: 1}", 67),
        ("{step: 5, direction: down}", 65),
        ("{step: 0.5, direction: up}", 67),
        ("{step: 0.1}", 66.7),
    ],
)
def test_rounding(tmp_path: Path, rounding: str, final: float) -> None:
    assert score(tmp_path, f"drop: [sampling]\nrounding: {rounding}").final == final


def test_what_is_a_multiple_already_is_not_rounded_up(tmp_path: Path) -> None:
    whole = replace(REPORT, results=(result("thin_lens", 0.7, 1.0),))
    text = "total: 1\nrounding: {step: 0.1, direction: up}"
    assert score(tmp_path, text, report=whole).final == 0.7


def test_points_that_are_added(tmp_path: Path) -> None:
    assert score(tmp_path, "students: {ada: {add: 3}}").final == 53
    assert score(tmp_path, "students: {ada: {add: -80}}").final == 0


def test_what_could_not_be_graded_has_no_score(tmp_path: Path) -> None:
    (tmp_path / "policy.yaml").write_text("total: 10")
    rules = read_policy(tmp_path / "policy.yaml", MODULES)
    assert mark(Report("eve", (), trouble="no zip file"), rules, ("eve",)) is None


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("total: 10\nweights: {glosy: 1}", ":2: weights.glosy: glosy is not graded; did you mean"),
        ("weights:\n  glossy: -1", ":2: weights.glossy is -1: expected a number >= 0"),
        ("weights: {glossy: 1}", ":1: weights: thin_lens is graded and has no weight"),
        ("weights: {glossy: 0}\ndrop: [thin_lens, sampling]", ":1: weights: nothing counts"),
        (LATE + "lates: 3", ":3: lates: unknown key; did you mean late or attempts?"),
        ("deadline: tomorrow\nlate: {percent_per_day: 1}", ':1: deadline is "tomorrow": expected'),
        (
            "deadline: 2026-10-01T10:00:00\nlate: {percent_per_day: 1}",
            "date and time with its zone",
        ),
        (DEADLINE, ":1: deadline: it changes nothing"),
        ("late: {percent_per_day: 1}", ":1: late: there is no deadline"),
        (DEADLINE + "late: {grace_minutes: 1}", ":2: late: percent_per_day is missing"),
        ("students: {ada: {excused: [bokeh]}}", "students.ada.excused[0]: bokeh is not graded"),
        ("students: {ada: 5}", ":1: students.ada is 5: expected a map"),
        ("rounding: {step: 0}", ":1: rounding.step is 0: expected a number > 0"),
        ("", "the file is empty: expected a policy"),
        ("times: none.csv", "none.csv: no such file"),
        ("times: bad.csv", 'bad.csv:2: submitted is "yesterday": expected a date'),
    ],
)
def test_mistakes_are_told_by_file_line_and_key(tmp_path: Path, text: str, told: str) -> None:
    (tmp_path / "bad.csv").write_text("student,submitted\nada,yesterday\n")
    (tmp_path / "policy.yaml").write_text(text)
    with pytest.raises(CourseError) as error:
        read_policy(tmp_path / "policy.yaml", MODULES)
    assert told in str(error.value)
