"""The student's page: whole, readable, and closed to what is not its own."""

import re
from collections.abc import Callable
from dataclasses import replace
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE, TAUGHT, WARM_UP
from course.school.grading.catalog import module_checks
from course.school.grading.checks.result import Result, Status
from course.school.grading.checks.running import run_checks
from course.school.grading.checks.trusted import TrustedModule
from course.school.grading.classes.policy import Mark
from course.school.grading.classes.roster import Matched
from course.school.grading.references import prepared, reference
from course.school.grading.report import FunctionResults, Report, docs_page, reproduce
from course.school.grading.reports.classes import ClassLine, write_class_page
from course.school.grading.reports.page import as_page

VOID = {"meta", "img", "br"}
# What SVG writes as <path/> comes as handle_startendtag.


class Page(HTMLParser):
    """A page, read strictly: every element is closed in its turn."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.tags: list[tuple[str, dict[str, str]]] = []
        self.words: list[tuple[str, str]] = []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, {name: value or "" for name, value in attrs}))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, {name: value or "" for name, value in attrs}))

    def handle_endtag(self, tag: str) -> None:
        assert self.open
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words.append((self.open[-1] if self.open else "", data))

    @property
    def text(self) -> str:
        return " ".join(" ".join(data for tag, data in self.words if tag != "style").split())

    def count(self, tag: str) -> int:
        return sum(name == tag for name, _ in self.tags)


def read(report: Report) -> Page:
    return Page(as_page(report))


def check_closed(page: Page) -> None:
    """Nothing runs, and nothing is loaded."""
    assert not {"script", "link", "iframe", "object", "embed", "base", "form"} & {
        tag for tag, _ in page.tags
    }
    for _tag, attributes in page.tags:
        assert not [name for name in attributes if name.startswith("on")]
        for name in ("src", "href", "xlink:href", "srcset", "poster", "data"):
            assert re.match(r"data:image/|#|\./|$", attributes.get(name, ""))
        assert "url(" not in attributes.get("style", "").replace("url(#", "")
    styles = "".join(data for tag, data in page.words if tag == "style")
    assert styles
    assert not re.search(r"url\(|@import|http", styles)


def test_the_page_says_everything(report: Report) -> None:
    page = read(report)
    check_closed(page)
    for text in (
        "ada",
        "3 of 11.5 points",
        "2 passed",
        "2 failed",
        "1 not attempted",
        "1 timeout",
        "1 crashed",
        "1 grader error",
        "a process; no network",
        "Seed 7",
        "Version 1.2.3",
        "hello from thin_lens",
        "Not attempted yet",
    ):
        assert text in page.text
    for result in report.results:
        assert result.title in page.text
        assert result.function in page.text
        if result.status not in ("passed", "not attempted"):
            for text in (result.expected, result.found, result.hint, result.says):
                assert text in page.text
            assert reproduce(result, 7) in page.text
            assert docs_page(result) in page.text


def test_headings_go_down_step_by_step(report: Report) -> None:
    page = read(report)
    levels = [int(tag[1]) for tag, _ in page.tags if re.fullmatch(r"h\d", tag)]
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))


def test_a_known_mistake_is_told_once_for_a_function(report: Report) -> None:
    page = read(report)
    assert page.text.count("You focus on a sphere") == 1
    assert "same mistake as above: wrong-plane" in page.text


def test_shapes_and_lengths_are_told_before_what_hangs_on_them(report: Report) -> None:
    failed = report.results[1]
    names = "density", "unit_length", "contract", "columns"
    results = (replace(failed, check=name, kind="property", of=1, says="") for name in names)
    told = FunctionResults(failed.module, failed.function, tuple(results)).told
    assert [result.check for result in told] == ["contract", "unit_length", "density", "columns"]


def test_a_wrong_dtype_is_told_after_what_is_worth_more(report: Report) -> None:
    failed = replace(report.results[1], kind="property", says="")
    dtype = replace(failed, check="contract", of=0.1, expected="u of dtype float32")
    told = FunctionResults(failed.module, failed.function, (dtype, replace(failed, of=1))).told
    assert [result.of for result in told] == [1, 0.1]


def test_what_was_said_before_is_folded(report: Report) -> None:
    first = report.results[1]
    again = [
        replace(
            first, check=f"again-{k}", title=f"Again {k}", same_as=first.id, mistake="", says=""
        )
        for k in range(3)
    ]
    page = read(replace(report, results=(first, *again)))
    assert page.text.count("Expected") == 1
    assert "3 checks more: 0.75" in page.text
    assert all(reproduce(result, 7) in page.text for result in again)


def test_a_module_that_can_not_be_used_is_told_once(report: Report) -> None:
    first = replace(report.results[1], found="no such file", module_wide=True, says="", mistake="")
    other = replace(first, function="point_on_disk", same_as=first.id)
    page = read(replace(report, results=(first, other)))
    check_closed(page)
    assert page.text.count("No function of this module could be checked. no such file") == 1
    assert page.text.count("no such file") == 1
    assert "point_on_disk" in page.text


def test_a_function_that_is_not_there_is_no_untouched_stub(report: Report) -> None:
    missing = replace(report.results[6], found="glossy.py has no jitter_on_plane")
    assert "glossy.py has no jitter_on_plane" in read(replace(report, results=(missing,))).text


def test_passed_checks_are_folded(report: Report) -> None:
    text = as_page(report)
    folded = "".join(re.findall(r"<details>.*?</details>", text, re.DOTALL))
    assert "2 checks passed" in folded
    assert "The picture looks like the reference" in folded
    assert "Rays meet in focus" not in folded


def test_hostile_texts_stay_texts(hostile_report: Report) -> None:
    page = read(hostile_report)
    check_closed(page)
    assert "<script>alert(1)</script> \"quote\" 'quote' &" in page.text
    assert "{{ 7 * 7 }}" in page.text
    raw = as_page(hostile_report)
    assert not re.search("[\x00-\x08\x0b-\x1f\ud800-\udfff\u202e]", raw)
    assert "red" in page.text
    assert "[31m" not in page.text


def test_without_a_name_and_without_results() -> None:
    page = read(Report("", (), trouble="The archive is <broken>."))
    assert "could not be graded" in page.text
    assert "The archive is <broken>." in page.text


def test_endless_output_is_cut(report: Report) -> None:
    page = read(replace(report, printed={"thin_lens": "x" * 10_000_000}))
    assert len(page.text) < 100_000
    assert "characters left out" in page.text


def test_a_picture_of_nothing_but_nan_is_a_page(with_figure: Callable[..., Report]) -> None:
    report = with_figure(
        "pictures", yours=np.full((3, 36, 48), np.nan), expected=np.full((3, 36, 48), 0.5)
    )
    page = read(report)
    check_closed(page)
    assert "NaN or infinite at 1728 of 1728 pixels" in page.text
    images = [attributes for tag, attributes in page.tags if tag == "img"]
    assert len(images) >= 3
    assert all(image["alt"] and image["src"].startswith("data:image/png") for image in images)


@pytest.mark.parametrize("kind", ["points", "histogram"])
def test_plots_are_in_the_page(with_figure: Callable[..., Report], kind: str) -> None:
    page = read(with_figure(kind, yours=np.random.default_rng(0).random((2, 60))))
    check_closed(page)
    assert page.count("svg") == 1
    assert [attributes["aria-label"] for _, attributes in page.tags if "role" in attributes]


def test_figures_of_passed_checks_are_not_drawn(
    with_figure: Callable[..., Report], report: Report
) -> None:
    shown = with_figure("points", yours=np.zeros((2, 9))).results[0]
    passed = replace(report.results[0], figures=shown.figures)
    assert not read(replace(report, results=(passed,))).count("svg")


def test_a_really_wrong_submission() -> None:
    right = reference("motion_blur")
    functions = {
        name: lambda *arguments, name=name: right.call(name, *arguments)
        for name in COURSE["motion_blur"]
    }
    functions["shutter_times"] = lambda first, last, u: first + (last - first) * u * u
    results: list[Result] = list(
        run_checks(
            module_checks("motion_blur"),
            TrustedModule(functions),
            prepared(right, 0),
            0,
            lambda check: (
                check.function == "shutter_times" and check.kind not in ("picture", "bias")
            ),
        )
    )
    assert any(result.status == "failed" and result.figures for result in results)
    page = read(Report("ada", tuple(results)))
    check_closed(page)
    assert page.count("svg") >= 1
    assert "course check motion_blur --only shutter_times/uniform --seed 0" in page.text


# ---------------------------------------------------------------- the class


def class_page(
    reports: list[Report], similar: list[tuple[str, str, str, float]], folder: Path
) -> Page:
    write_class_page(reports, similar, folder / "class.html")
    return Page((folder / "class.html").read_text(encoding="utf-8"))


def test_the_class_at_a_glance(report: Report, tmp_path: Path) -> None:
    perfect = replace(report, student="bob", results=report.results[:1])
    broken = Report("eve/../x y", (), trouble="no zip file", seed=7, version="1.2.3")
    similar = [("ada", "bob", "glossy", 0.5), ("ada", "eve/../x y", "thin_lens", 0.93)]
    page = class_page([report, perfect, broken], similar, tmp_path)
    check_closed(page)
    for text in (
        "3 submissions",
        "2 graded: mean score 63 %, median 63 %, from 26 % to 100 %",
        "no zip file",
        "thin_lens.lens_rays/focus",
        "1 not attempted",
        "wrong-plane × 1",
        "93 %",
        "Seed 7",
        "Version 1.2.3",
        "26 % 3 of 11.5",
    ):
        assert text in page.text
    assert page.text.index("93 %") < page.text.index("glossy 50 %")
    hrefs = {attributes["href"] for tag, attributes in page.tags if tag == "a"}
    sections = {f"#{attributes['id']}" for _, attributes in page.tags if "id" in attributes}
    assert {href for href in hrefs if href.startswith("#")} == sections
    assert {"#students", "#ungraded", "#misconceptions", "#failures", "#similar"} <= sections
    links = hrefs - sections
    assert links == {
        "./ada/report.html",
        "./bob/report.html",
        "./lecture.html",
        "./eve%2F..%2Fx%20y/report.html",
    }
    (chart,) = [attributes for tag, attributes in page.tags if tag == "svg"]
    assert "1 from 20 to 30 %" in chart["aria-label"]
    assert "1 from 90 to 100 %" in chart["aria-label"]


def test_the_most_frequent_failure_comes_first(report: Report, tmp_path: Path) -> None:
    late = replace(report, results=(replace(report.results[-1], status=report.results[1].status),))
    right = replace(report, results=(replace(report.results[1], status=Status.PASSED, mistake=""),))
    twice = replace(report, results=report.results[:2])
    page = class_page([late, report, twice, right], [], tmp_path)
    assert page.text.index("lens_rays/focus") < page.text.index("lens_rays/picture")
    assert "2 of 3 67 % thin_lens.lens_rays/focus" in page.text


def test_what_was_not_attempted_is_no_failure_and_told_apart(
    report: Report, tmp_path: Path
) -> None:
    failed = report.results[1]
    not_written = replace(failed, status=Status.NOT_ATTEMPTED, mistake="", says="")
    results = {"bob": failed, "cyd": not_written, "dan": not_written}
    reports = [replace(report, student=name, results=(one,)) for name, one in results.items()]
    text = class_page([report, *reports], [], tmp_path).text
    mistakes, _, failures = text.rpartition("Failures of each check")
    for found in (mistakes, failures):
        assert "2 of 2 100 %" in found
        assert "not attempted by 2" in found
    # Nobody has written the one, and the other has broken by itself.
    assert "jitter_on_plane" not in failures
    assert "jitter_in_ball" not in failures


def test_whoever_opens_the_page_sees_the_students_first(report: Report, tmp_path: Path) -> None:
    class_page([report] * 30, [], tmp_path)
    text = (tmp_path / "class.html").read_text(encoding="utf-8")
    first, *_, last = re.findall("<h2>(.*?)</h2>", text)
    assert (first, last) == ("Students", "How this was graded")
    assert text.index("<nav") < text.index("<h2>")


def test_points_have_two_decimals_at_most(report: Report, tmp_path: Path) -> None:
    results = tuple(replace(one, points=one.points / 3, of=one.of / 3) for one in report.results)
    thirds = replace(report, results=results)
    assert "0 of 0.83" in read(thirds).text
    lines = {"ada": ClassLine((), Mark(100 / 3, 200 / 3, 500 / 3))}
    write_class_page([thirds], [], tmp_path / "class.html", lines, 100.0)
    for text in (as_page(thirds), (tmp_path / "class.html").read_text(encoding="utf-8")):
        assert not re.search(r"(?<![\w.])\d+\.\d{3,} (of|points)|of \d+\.\d{3,}", text)
    assert "33.33 66.67 166.67" in Page(text).text


def test_modules_come_in_the_order_in_which_they_are_taught(report: Report) -> None:
    names = "soft_shadows", "unheard_of", "sampling", "supersampling"
    results = tuple(replace(report.results[1], module=name) for name in names)
    found = re.findall("<h2>(.*?)</h2>", as_page(replace(report, results=results)))
    assert found[:4] == ["sampling", "supersampling", "soft_shadows", "unheard_of"]
    cards = (PROJECT / "docs" / "sitebuild" / "cards.py").read_text(encoding="utf-8")
    assert re.search(r"from course.engine.functions.modules import .*\bTAUGHT\b", cards)
    assert [*TAUGHT][:2] == [WARM_UP, "supersampling"]


def test_a_class_of_hostile_texts(hostile_report: Report, hostile: str, tmp_path: Path) -> None:
    broken = Report(hostile, (), trouble=hostile)
    page = class_page([hostile_report, broken], [(hostile, hostile, hostile, 1.0)], tmp_path)
    check_closed(page)
    assert "<script>alert(1)</script>" in page.text


def test_an_empty_class_is_a_page(tmp_path: Path) -> None:
    assert "0 submissions" in class_page([], [], tmp_path).text


def test_remarks_scores_and_the_roster_are_on_the_page(
    report: Report, hostile: str, tmp_path: Path
) -> None:
    broken = Report("eve", (), trouble="no zip file")
    lines = {
        "ada": ClassLine(
            (f"{hostile} was graded as glossy.py",), Mark(52.5, 47.25, 47.5, ("1 day late",))
        ),
        "eve": ClassLine(("typed into Moodle",)),
    }
    matched = Matched({}, ("Lee, Ann", hostile), ("eve",))
    write_class_page(
        [report, broken],
        [],
        tmp_path / "class.html",
        lines,
        100.0,
        not_compared=[("ada", "glossy")],
        matched=matched,
    )
    page = Page((tmp_path / "class.html").read_text(encoding="utf-8"))
    check_closed(page)
    for text in (
        "1 day late",
        "was graded as glossy.py",
        "typed into Moodle",
        "Submissions of nobody in the roster eve",
        "In the roster, without a submission Lee, Ann; ",
        "it took too long: ada (glossy).",
        "Raw Adjusted Final",
        "52.5 47.25 47.5",
    ):
        assert text in page.text
