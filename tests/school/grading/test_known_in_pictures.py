"""Known submissions of `sampling` and `adaptive_sampling` before the picture and bias checks of their functions.

Right ones pass those of bias, as `test_mutants` has all others. Of the wrong ones those are named here that a picture
has to show; `CAUGHT_BY` names another check for most of them, which `test_mutants` holds.
"""

import pytest

from course.school.grading.calibration import trusted
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import ModuleChecks, References
from course.school.grading.checks.result import Status
from course.school.grading.checks.running import run_checks
from course.school.grading.known import KnownSubmission, known

SHOWN = {
    ("sampling", "bias"): {
        *("ball_cylinder", "ball_zeroed", "ball_crowded", "ball_one_number", "ball_poles"),
        *("ball_surface", "sphere_half", "sphere_poles"),
    },
    ("sampling", "picture"): {"sphere_half"},
    ("adaptive_sampling", "picture"): {
        *("all_channels", "brightness", "channels_mixed", "from_mean", "inverted", "one_for_all"),
        *("relative", "signed", "flat", "gap", "half_of_the_end", "sizes"),
    },
}


def statuses(submission: KnownSubmission, kind: str, references: References) -> dict[str, Status]:
    """By function, of the checks of a kind; for a wrong submission of its wrong function alone."""
    module = submission.module
    checks = [
        check
        for check in module_checks(module).checks
        if check.kind == kind and submission.function in ("", check.function)
    ]
    alone = ModuleChecks(module, tuple(checks))
    results = run_checks(alone, trusted(submission), references, 0)
    return {result.function: result.status for result in results}


RIGHT = [submission for submission in known("sampling") if submission.right]


@pytest.mark.parametrize("submission", RIGHT, ids=[k.name for k in RIGHT])
def test_right_ones_pass(submission: KnownSubmission, usual_references: References) -> None:
    found = statuses(submission, "bias", usual_references)
    assert found
    assert set(found.values()) == {Status.PASSED}, found


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize(("module", "kind"), SHOWN)
def test_wrong_ones_are_shown(module: str, kind: str, usual_references: References) -> None:
    wrong = {submission.name: submission for submission in known(module) if not submission.right}
    for name in sorted(SHOWN[module, kind]):
        found = statuses(wrong[name], kind, usual_references)
        assert found == {wrong[name].function: Status.FAILED}, name
