"""The rays behind a wrong picture: of the reference's own picture, and shown where a picture fails and nowhere else."""

import json
import zlib
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import References, Trial
from course.school.grading.checks.result import Status
from course.school.grading.checks.running import run_checks
from course.school.grading.known import known, trusted
from course.school.grading.pictures.catalog import RAYS
from course.school.grading.pictures.rays import PIXELS, SAMPLES
from course.school.grading.report import Report
from course.school.grading.reports.page import as_page

SHOWN = ("soft_shadows.point_on_sphere", "motion_blur.shutter_times", "thin_lens.lens_rays")


@pytest.mark.parametrize("path", SHOWN)
def test_what_is_kept_is_of_the_references_picture(path: str, usual_references: References) -> None:
    module, function = path.split(".")
    checks = module_checks(module)
    (picture,) = (c for c in checks.checks if c.name == "picture" and c.function == function)
    whole = usual_references(module, picture)["picture"]
    text = zlib.decompress(usual_references(module, RAYS[module][function])["rays"].tobytes())
    for (x, y), kept in zip(PIXELS, json.loads(text), strict=True):
        np.testing.assert_allclose(kept["color"], whole[:, y, x], rtol=1e-4, atol=1e-9)
        assert len(kept["samples"]) == min(SAMPLES, kept["all"])


def report(name: str, references: References, **changed: Any) -> Report:
    """Of a known wrong submission of soft_shadows, by its pictures alone."""
    submission = next(k for k in known("soft_shadows") if k.name == name)
    own = trusted(submission)
    checks = replace(module_checks("soft_shadows"), **changed)

    def only(check: Any) -> bool:
        return bool(check.name == "picture" and check.function == submission.function)

    return Report("", tuple(run_checks(checks, own, references, 0, only)))


def test_a_wrong_picture_has_its_rays_and_a_right_one_none(usual_references: References) -> None:
    wrong = report("ball_centre_forgotten", usual_references)
    (result,) = wrong.results
    assert result.status is Status.FAILED
    assert [figure.kind for figure in result.figures] == ["pictures", "rays"]
    page = as_page(wrong)
    assert "For sample " in page
    assert len(page.encode()) < 400_000
    # Its mistake is none that 64 samples of a picture show.
    (result,) = report("ball_crowded_middle", usual_references).results
    assert result.status is Status.PASSED
    assert "<script" not in as_page(Report("", (result,)))


def test_rays_that_cannot_be_had_leave_the_check_as_it_is(usual_references: References) -> None:
    def breaks(_: Trial) -> None:
        raise RuntimeError("no rays")

    checks = module_checks("soft_shadows")
    broken = replace(checks.rays["point_in_ball"], run=breaks)
    (result,) = report(
        "ball_centre_forgotten", usual_references, rays={"point_in_ball": broken}
    ).results
    assert result.status is Status.FAILED
    assert [figure.kind for figure in result.figures] == ["pictures"]
