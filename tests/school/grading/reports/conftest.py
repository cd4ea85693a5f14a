"""Reports made by hand, one of them of texts that want to break out of a file."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from course.school.grading.checks.check import Figure
from course.school.grading.checks.result import Result, Status
from course.school.grading.report import Report

HOSTILE = "<script>alert(1)</script> \"quote\" 'quote' & \x00\x08\x1b[31mred\x1b[0m \ud800 \u202e ]]> {{ 7 * 7 }}"

PASSED = Result(
    "thin_lens", "lens_rays", "contract", "Arguments", "contract", Status.PASSED, 1, 1, seconds=0.5
)
ALL = (
    PASSED,
    replace(
        PASSED,
        check="focus",
        title="Rays meet in focus",
        status=Status.FAILED,
        points=0.0,
        of=2.5,
        expected="0.25 within 1e-6",
        found="0.75",
        where="u = 0.5",
        hint="Look at the plane of focus.",
        mistake="wrong-plane",
        says="You focus on a sphere, not on a plane.",
    ),
    replace(
        PASSED,
        check="far",
        title="Far away",
        status=Status.FAILED,
        points=0.0,
        found="nan",
        mistake="wrong-plane",
        says="You focus on a sphere, not on a plane.",
    ),
    replace(
        PASSED,
        function="point_on_disk",
        check="slow",
        title="Ends in time",
        status=Status.TIMEOUT,
        points=0.0,
    ),
    replace(
        PASSED,
        module="glossy",
        function="keep_above",
        check="crash",
        status=Status.CRASHED,
        points=0.0,
    ),
    replace(
        PASSED,
        module="glossy",
        function="jitter_in_ball",
        check="fault",
        status=Status.GRADER_ERROR,
        found="ZeroDivisionError",
        where="Traceback\n  line 1",
    ),
    replace(
        PASSED,
        module="glossy",
        function="jitter_on_plane",
        check="missing",
        title="Is there",
        status=Status.NOT_ATTEMPTED,
        points=0.0,
        of=3.0,
        found="not written yet",
    ),
    # The checks that judge pictures come last.
    replace(PASSED, check="picture", title="The picture looks like the reference"),
)


@pytest.fixture
def hostile() -> str:
    """Markup, quotes, control characters, a lone surrogate, and a template's own signs."""
    return HOSTILE


@pytest.fixture
def report() -> Report:
    """All six statuses in two modules: 3 of 11.5 points."""
    return Report(
        "ada",
        ALL,
        {"thin_lens": "hello from thin_lens"},
        ("a process", "no network"),
        7,
        "1.2.3",
        4.5,
    )


@pytest.fixture
def hostile_report(report: Report) -> Report:
    """Every text that there is, hostile."""
    texts = ("check", "title", "expected", "found", "where", "hint", "mistake", "says")
    return replace(
        report,
        student=HOSTILE,
        printed={"thin_lens": HOSTILE, HOSTILE: HOSTILE},
        protections=(HOSTILE,),
        remarks=(HOSTILE,),
        version=HOSTILE,
        results=tuple(
            replace(
                result, **dict.fromkeys(texts, HOSTILE), figures=(Figure("points", HOSTILE, {}),)
            )
            for result in ALL
        ),
    )


@pytest.fixture
def with_figure(report: Report) -> Callable[..., Report]:
    """A report whose one check has failed and shows this."""

    def make(kind: Any, **arrays: Any) -> Report:
        return replace(
            report, results=(replace(ALL[1], figures=(Figure(kind, "A figure", arrays),)),)
        )

    return make
