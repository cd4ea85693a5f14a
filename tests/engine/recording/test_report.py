"""The page of a check with rays in it: both sides, each by itself, and in words without a script."""

from typing import Any

import pytest

from course.school.grading.catalog import module_checks
from course.school.grading.checks.running import run_checks
from course.school.grading.known import known, trusted
from course.school.grading.references import prepared, reference
from course.school.grading.report import Report
from course.school.grading.reports.page import as_page
from tests.browser import untroubled


@pytest.fixture(scope="module")
def page() -> str:
    """Of a known wrong submission, by its picture alone."""
    wrong = next(k for k in known("soft_shadows") if k.name == "ball_centre_forgotten")
    results = run_checks(
        module_checks("soft_shadows"),
        trusted(wrong),
        prepared(reference("soft_shadows"), 0),
        0,
        lambda check: check.name == "picture" and check.function == wrong.function,
    )
    return as_page(Report("", tuple(results)))


PIXELS_OF_VIEW = "() => document.querySelector('.rays canvas').toDataURL()"
SETTLED = "() => new Promise((d) => requestAnimationFrame(() => requestAnimationFrame(d)))"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_page_shows_both_and_each_by_itself(
    browser: Any, tmp_path: Any, page: str, scheme: str
) -> None:
    accessibility = pytest.importorskip("tests.docs.test_accessibility")
    file = tmp_path / "report.html"
    file.write_text(page, encoding="utf-8")
    options = {"viewport": {"width": 390, "height": 844}, "color_scheme": scheme}
    with untroubled(browser, **options) as tab:
        tab.goto(file.as_uri())
        tab.locator(".rays").scroll_into_view_if_needed()
        tab.wait_for_selector(".rays canvas")
        assert tab.locator(".rays circle.sample.chosen").count() > 0
        seen = []
        for who in ("-1", "0", "1"):
            tab.check(f"input[data-who='{who}']")
            tab.evaluate(SETTLED)
            seen.append(tab.evaluate(PIXELS_OF_VIEW))
        assert len(set(seen)) == 3
        tab.select_option(".rays select", label="light 0")
        tab.evaluate(SETTLED)
        assert tab.evaluate(PIXELS_OF_VIEW) != seen[-1]
        assert tab.evaluate("document.documentElement.scrollWidth") <= 390
        for rules in (accessibility.RULES, accessibility.COLOURS):
            assert accessibility._faults(tab, rules) == []


def test_without_scripts_the_page_says_it_in_words(browser: Any, tmp_path: Any, page: str) -> None:
    file = tmp_path / "report.html"
    file.write_text(page, encoding="utf-8")
    with untroubled(browser, java_script_enabled=False) as tab:
        tab.goto(file.as_uri())
        assert "soft_shadows.point_in_ball(center = " in tab.inner_text("main")
