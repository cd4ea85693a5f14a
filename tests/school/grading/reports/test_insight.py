"""What a class has understood: mistakes counted by name, groups without one, changes, and a page without names."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from course.school.grading.checks.result import Result, Status
from course.school.grading.known import known
from course.school.grading.report import Report
from course.school.grading.reports.classes import PAIRS, write_class_page
from course.school.grading.reports.insight import (
    Changed,
    _example,
    changes,
    misconceptions,
    without_name,
    write_lecture_page,
)


def result(function: str, check: str, mistake: str = "", *, passed: bool = False) -> Result:
    module, _, name = function.partition(".")
    status = Status.PASSED if passed else Status.FAILED
    return Result(
        module,
        name,
        check,
        f"Title of {check}",
        "property",
        status,
        float(passed),
        1.0,
        expected="1",
        found="2",
        mistake=mistake,
        says=f"You {mistake}." if mistake else "",
    )


def report(student: str, *results: Result) -> Report:
    return Report(student, results)


RIGHT = result("soft_shadows.point_on_sphere", "uniform", passed=True)
CROWDS = result("soft_shadows.point_on_sphere", "uniform", "crowded-poles")
UNKNOWN = result("soft_shadows.point_on_sphere", "uniform")
NOT_WRITTEN = replace(UNKNOWN, status=Status.NOT_ATTEMPTED)


def test_mistakes_are_counted_among_those_who_have_written_the_function() -> None:
    graded = [
        report("ada", CROWDS, replace(CROWDS, check="moments")),
        report("bob", CROWDS),
        report("cyd", RIGHT),
        report("dan", NOT_WRITTEN),
    ]
    (found,) = misconceptions(graded)
    assert (found.mistake, found.students) == ("crowded-poles", ("ada", "bob"))
    assert (found.tried, found.untried) == (3, 1)
    assert found.share == pytest.approx(2 / 3)
    assert found.says == "You crowded-poles."


def test_what_has_no_name_is_grouped_by_the_checks_that_fail() -> None:
    radius = result("soft_shadows.point_on_sphere", "radius")
    graded = [
        report("ada", UNKNOWN, radius),
        report("bob", UNKNOWN),
        report("cyd", UNKNOWN),
        report("dan", CROWDS, radius),
        report("eve", NOT_WRITTEN),
        report("fay", replace(UNKNOWN, module_wide=True)),
    ]
    found = [(one.checks, one.students) for one in without_name(graded)]
    assert found == [(("uniform",), ("bob", "cyd")), (("uniform", "radius"), ("ada",))]


def test_changes_are_those_of_functions() -> None:
    earlier = {
        "ada": report("ada", CROWDS),
        "bob": report("bob", RIGHT),
        "cyd": report("cyd", RIGHT),
    }
    now = [report("ada", RIGHT), report("bob", UNKNOWN), report("cyd", RIGHT), report("new", RIGHT)]
    name = "soft_shadows.point_on_sphere"
    assert changes(earlier, now) == [
        Changed("bob", 1.0, 0.0, (), (name,)),
        Changed("ada", 0.0, 1.0, (name,), ()),
    ]


def test_the_page_for_the_lecture_hall_has_no_names(tmp_path: Path) -> None:
    (poles,) = [one for one in known("soft_shadows") if one.name == "sphere_crowded_poles"]
    made = replace(CROWDS, mistake=poles.mistake)
    students = [f"Ada Unmistakable {k}" for k in range(18)]
    graded = [report(student, made) for student in students] + [
        report(f"Bob Unmistakable {k}", RIGHT) for k in range(42)
    ]
    write_lecture_page(graded, tmp_path / "lecture.html")
    text = (tmp_path / "lecture.html").read_text(encoding="utf-8")
    assert "Unmistakable" not in text
    assert "18 of 60 in <code>point_on_sphere</code>" in text
    # The picture is that of the course's own submission with the mistake.
    assert re.search(r"<svg|<img", text)


def made(path: str) -> Result:
    """What a student gets who makes the mistake of a known submission, "module.name"."""
    module, name = path.split(".")
    (one,) = [one for one in known(module) if one.name == name]
    return result(f"{module}.{one.function}", one.caught_by, one.mistake)


def test_beside_a_mistake_is_what_is_right(tmp_path: Path) -> None:
    paths = "soft_shadows.sphere_crowded_poles", "soft_shadows.grid_both_edges"
    paths += "thin_lens.circle_radius", "sampling.disk_rim"
    graded = [report("ada", *map(made, paths)), report("bob", result("glossy.f", "c", "slip"))]
    write_lecture_page(graded, tmp_path / "lecture.html")
    text = (tmp_path / "lecture.html").read_text(encoding="utf-8")
    modules = re.findall('<h2 id="(.*?)"', text)
    assert modules == ["sampling", "soft_shadows", "glossy", "thin_lens"]
    sections = re.findall('<section class="misconception">(.*?)</section>', text, re.DOTALL)
    shown = {str(re.search("<code>(.*?)</code>", one)[1]): one for one in sections}  # type: ignore[index]
    for function in ("disk_by_polar", "point_on_sphere", "light_grid"):
        titles = re.findall("<figcaption><b>(.*?)</b>", shown[function])
        assert titles[:2] == ["As it should be", "With this mistake"]
    assert "<img" in shown["light_grid"]
    assert "Signed difference" in shown["light_grid"]
    # Nothing is drawn of it, but there are numbers.
    assert "compare numbers" in shown["circle_of_confusion"]
    assert "aperture_radius" in shown["circle_of_confusion"]
    assert "the course has no example" in shown["f"]
    assert not re.search(r"\b([Yy]ours|[Rr]eference|noise)\b", re.sub("<p class=.says.*", "", text))


def test_a_mistake_of_order_is_drawn_over_the_numbers_and_not_as_two_equal_histograms(
    tmp_path: Path,
) -> None:
    paths = "motion_blur.backwards", "motion_blur.squared_u"
    graded = [report(path, made(path)) for path in paths]
    write_lecture_page(graded, tmp_path / "lecture.html")
    text = (tmp_path / "lecture.html").read_text(encoding="utf-8")
    sections = re.findall('<section class="misconception">(.*?)</section>', text, re.DOTALL)
    backwards, squared = (re.findall('aria-label="(.*?)"', one) for one in sections)
    assert "backwards" in sections[0]
    right, wrong = backwards
    assert re.fullmatch(r"As it should be: 1000 values over u; 0.00\d+ at .*; 0.99\d* at .*", right)
    assert re.fullmatch(r"With this mistake: .*; 0.99\d* at .*; 0.00\d+ at .*", wrong)
    # Where how often a value comes tells the two apart, that is drawn.
    assert [one.partition(":")[0] for one in squared] == ["Histogram", "Histogram"]


def test_a_call_whose_result_is_right_is_no_picture_of_a_mistake(tmp_path: Path) -> None:
    """Only its third coordinate is wrong, and the other two are drawn."""
    graded = [report("ada", made("importance_sampling.cosine_not_lifted"))]
    write_lecture_page(graded, tmp_path / "lecture.html")
    text = (tmp_path / "lecture.html").read_text(encoding="utf-8")
    assert "No picture shows it" in text
    assert "<svg" not in text


def test_misconceptions_stand_by_module_as_taught_and_the_most_frequent_of_all_first(
    tmp_path: Path,
) -> None:
    often = {"thin_lens.rare": 1, "thin_lens.often": 3, "sampling.warm": 2, "glossy.most": 5}
    graded = [
        report(f"student {k}", *(result(f, "c", f"m-{f}") for f, n in often.items() if k < n))
        for k in range(6)
    ]
    write_class_page(graded, [], tmp_path / "class.html")
    text = (tmp_path / "class.html").read_text(encoding="utf-8")
    (section,) = re.findall('<section id="misconceptions">(.*?)</section>', text, re.DOTALL)
    assert re.findall('<h3 id="made-.*?">(.*?)</h3>', section) == [
        "sampling",
        "glossy",
        "thin_lens",
    ]
    (first,) = re.findall("<p>Most frequent: (.*?)</p>", section)
    names = ["glossy.most", "thin_lens.often", "sampling.warm"]
    assert re.findall("<code>(.*?)</code>", first) == names
    assert "(5 of 5)" in first
    for module in re.findall('href="#(.*?)"', first):
        assert f'id="{module}"' in section
    rows = re.findall('<th scope="row"><code>(.*?)</code>', section)
    assert rows == ["sampling.warm", "glossy.most", "thin_lens.often", "thin_lens.rare"]


def test_many_misconceptions_are_folded_module_by_module(tmp_path: Path) -> None:
    made = [result(f"{m}.f", f"c{k}", f"m{k}") for m in ("glossy", "film") for k in range(11)]
    write_class_page([report("ada", *made)], [], tmp_path / "class.html")
    text = (tmp_path / "class.html").read_text(encoding="utf-8")
    folded = "<details><summary>11 mistakes; most often <code>f</code>: m0, by 1 of 1</summary>"
    assert text.count(folded) == 2


def test_a_page_of_500_students_is_small_and_leads_to_each(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    checks = [f"check {k}" for k in range(6)]
    graded = []
    for k in range(500):
        results = [
            result(
                f"{module}.{name}",
                check,
                f"mistake {m}" if (m := rng.integers(40)) < 3 else "",
                passed=m > 20,
            )
            for module, name in (("soft_shadows", "light_grid"), ("glossy", "keep_above"))
            for check in checks
        ]
        graded.append(report(f"student {k}", *results))
    write_class_page(graded, [], tmp_path / "class.html")
    text = (tmp_path / "class.html").read_text(encoding="utf-8")
    assert len(text) < 500_000
    for k in range(500):
        assert f'href="./student%20{k}/report.html"' in text
    assert "<h2>Misconceptions</h2>" in text
    # What is long is folded, so that the page is as long as that of a small class.
    assert "<details><summary>500 students</summary>" in text
    shown = re.sub("<details>.*?</details>", "", text, flags=re.DOTALL)
    assert shown.count("<tr>") < 100


def test_long_tables_do_not_bury_what_a_lecturer_looks_for(tmp_path: Path) -> None:
    def graded(passed: bool) -> list[Report]:
        one = result("glossy.keep_above", "check", passed=passed)
        return [report(f"student {k}", one) for k in range(30)]

    similar = [(f"a{k}", f"b{k}", "glossy", k / 1000) for k in range(PAIRS + 7)]
    earlier = {one.student: one for one in graded(False)}
    write_class_page(graded(True), similar, tmp_path / "class.html", earlier=earlier)
    text = (tmp_path / "class.html").read_text(encoding="utf-8")
    assert text.index("Misconceptions</h2>") < text.index("Handed in again</h2>")
    assert "<details><summary>30 students</summary>" in text
    # The most alike are those that are listed.
    assert "And 7 pairs less alike." in text
    assert "./a7/" in text
    assert "./a6/" not in text


@pytest.mark.parametrize(
    ("function", "mistake"),
    [
        ("soft_shadows.point_on_sphere", "half-sphere"),
        ("soft_shadows.point_on_sphere", "crowded-poles"),
        ("sampling.sphere_by_polar", "sphere-upper-half"),
        ("cube_map.face_and_uv", "upside-down"),
        ("cube_map.face_and_uv", "u-for-v"),
        ("cube_map.face_and_uv", "mirrored"),
    ],
)
def test_points_show_a_mistake_without_a_word(function: str, mistake: str) -> None:
    """A tenth of the points is in another one of 8 x 8 cells; of 2000 right ones noise moves some 7%."""
    example = _example(*function.split("."), mistake)
    assert example is not None
    assert example.figure is not None
    cells = [
        np.histogram2d(*points, bins=8, range=[(-1, 1), (-1, 1)])[0] / points.shape[1]
        for points in (example.figure.arrays[name] for name in ("yours", "expected"))
    ]
    assert np.abs(cells[0] - cells[1]).sum() / 2 > 0.12
