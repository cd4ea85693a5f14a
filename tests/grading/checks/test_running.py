"""References are made once, and no fault of a check or of a mistake's description ends the grading."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from course.grading.checks.check import Array, Caller, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.running import KEPT, Status, generator, prepared, run_checks
from course.grading.checks.trusted import TrustedModule

MODULE = TrustedModule({"it": lambda: 1})


class Counted:
    """Prepares numbers and counts how often it has to."""

    def __init__(self) -> None:
        self.times = 0

    def __call__(self, reference: Caller, rng: np.random.Generator) -> dict[str, Array]:
        self.times += 1
        return {"numbers": rng.random(3) + reference.call("it")}


def check(prepare: Counted | None, name: str = "numbers") -> Check:
    return Check("it", name, "It is right", lambda _trial: None, prepare=prepare)


def test_references_are_made_once_for_each_check() -> None:
    count = Counted()
    one, other = check(count), check(count, "others")
    make = prepared(MODULE, 5)
    first = make("module", one)["numbers"]
    assert np.array_equal(first, generator(5, "module", one).random(3) + 1)
    assert make("module", one)["numbers"] is first
    assert count.times == 1
    assert not np.array_equal(make("module", other)["numbers"], first)
    assert not np.array_equal(make("elsewhere", one)["numbers"], first)
    assert count.times == 3
    # Another seed and another check of the same name are something else.
    assert not np.array_equal(prepared(MODULE, 6)("module", one)["numbers"], first)
    make("module", replace(one, prepare=Counted()))
    assert count.times == 4


def test_of_many_checks_the_latest_are_kept() -> None:
    count = Counted()
    make = prepared(MODULE, 0)
    checks = [check(count, f"{k}") for k in range(KEPT + 1)]
    for each in (*checks, checks[-1]):
        make("module", each)
    assert count.times == KEPT + 1
    make("module", checks[0])
    assert count.times == KEPT + 2


def test_a_check_without_references_gets_none() -> None:
    assert prepared(MODULE, 0)("module", check(None)) == {}


def test_no_check_changes_what_the_next_one_compares_with() -> None:
    make = prepared(MODULE, 0)
    with pytest.raises(ValueError, match="read-only"):
        make("module", check(Counted()))["numbers"][0] = 0


def fails(_trial: Trial) -> None:
    raise Failure("2", "1")


def test_a_mistake_that_can_not_look_at_what_came_back_is_not_it() -> None:
    checks = ModuleChecks(
        "module",
        (Check("it", "value", "It is 2", fails),),
        (
            Mistake("it", "of-no-dtype", "Never told", lambda trial: trial.call().dtype == float),
            Mistake("it", "one", "You return 1.", lambda trial: trial.call() == 1),
        ),
    )
    (result,) = run_checks(checks, MODULE, prepared(MODULE, 0), 0)
    assert result.status is Status.FAILED
    assert (result.mistake, result.says) == ("one", "You return 1.")
