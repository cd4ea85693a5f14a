"""Convergence checks: known submissions pass or fail, chance lets none fall, and junk is the student's own."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from course.effects import COURSE, PROJECT, Effects
from course.grading.calibration import trusted
from course.grading.checks.check import Check, ModuleChecks
from course.grading.checks.order import ORDERS
from course.grading.checks.result import Result, Status
from course.grading.checks.running import run_checks
from course.grading.checks.trusted import TrustedModule
from course.grading.known import known

CHECKS = [(module, check) for module, checks in ORDERS.items() for check in checks]
IDS = [f"{module}.{check.function}" for module, check in CHECKS]
FURTHER = ("sampling", "importance_sampling", "quasi_monte_carlo", "path_tracing")

Function = Callable[..., Any]


def solution(module: str) -> dict[str, Function]:
    effects = Effects(PROJECT / "solutions")
    return {name: effects.function(module, name) for name in COURSE[module]}


def judged(module: str, check: Check, functions: dict[str, Function] | None, seed: int) -> Result:
    caller = TrustedModule(functions or solution(module))
    (result,) = run_checks(ModuleChecks(module, (check,), ()), caller, lambda *_: {}, seed)
    return result


@pytest.mark.parametrize(("module", "check"), CHECKS, ids=IDS)
def test_the_reference_converges_for_every_seed(module: str, check: Check) -> None:
    """A check fails once in 10^7 by chance, as it says."""
    for seed in range(3):
        assert judged(module, check, None, seed).status is Status.PASSED


@pytest.mark.parametrize("module", FURTHER)
def test_right_submissions_converge(module: str) -> None:
    for submission in known(module):
        if submission.right:
            for result in run_checks(
                ModuleChecks(module, ORDERS[module], ()), trusted(submission), lambda *_: {}, 1
            ):
                assert result.status is Status.PASSED, (submission.name, result)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize(
    ("module", "name"),
    [
        ("sampling", "disk_crowded"),
        ("sampling", "ball_square_root"),
        ("sampling", "sphere_poles"),
        ("importance_sampling", "uniform_by_angle"),
        ("importance_sampling", "cosine_one_number"),
        ("importance_sampling", "estimate_times"),
        ("importance_sampling", "estimate_one_sample"),
        ("quasi_monte_carlo", "halton_one_base"),
        ("quasi_monte_carlo", "halton_all_bases"),
        ("path_tracing", "bounce_uniform"),
    ],
)
def test_wrong_submissions_do_not(module: str, name: str) -> None:
    (submission,) = (one for one in known(module) if one.name == name)
    (check,) = (check for check in ORDERS[module] if check.function == submission.function)
    (result,) = run_checks(
        ModuleChecks(module, (check,), ()), trusted(submission), lambda *_: {}, 1
    )
    assert result.status is Status.FAILED


@pytest.mark.parametrize("function", ["halton", "hammersley"])
def test_random_points_are_not_even(function: str) -> None:
    """Their order is 1/2, with a standard deviation below 0.05: 0.75 is five of them off."""
    rng = np.random.default_rng(0)
    functions = solution("quasi_monte_carlo") | {
        "halton": lambda i, dims: rng.random((dims, len(i)), np.float32),
        "hammersley": lambda n, dims: rng.random((dims, n), np.float32),
    }
    (check,) = (check for check in ORDERS["quasi_monte_carlo"] if check.function == function)
    result = judged("quasi_monte_carlo", check, functions, 0)
    assert result.status is Status.FAILED
    assert "N^-0." in result.found


def test_numbers_of_their_own_are_found_out() -> None:
    """A warp that draws anew is distributed as it should be, and yet no better than chance."""
    rng = np.random.default_rng(0)
    functions = solution("sampling")
    right = functions["disk_by_polar"]
    functions["disk_by_polar"] = lambda u: right(rng.random(u.shape, np.float32))
    (check,) = (check for check in ORDERS["sampling"] if check.function == "disk_by_polar")
    result = judged("sampling", check, functions, 0)
    assert result.status is Status.FAILED
    assert 0.3 < float(result.found.removeprefix("N^-")) < 0.65


JUNK: dict[str, Any] = {
    "None": None,
    "one number": 0.5,
    "a tuple": (1.0, 2.0, 3.0),
    "another shape": np.zeros((7, 3), np.float32),
    "booleans": np.zeros((3, 5), bool),
    "text": "points",
}


@pytest.mark.parametrize("junk", JUNK)
@pytest.mark.parametrize(("module", "check"), CHECKS, ids=IDS)
def test_junk_is_the_students_failure(module: str, check: Check, junk: str) -> None:
    functions = solution(module) | {check.function: lambda *_: JUNK[junk]}
    assert judged(module, check, functions, 0).status is Status.FAILED
