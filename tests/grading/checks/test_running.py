"""References are made once, and no fault of a check or of a mistake's description ends the grading."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from course.grading.checks.check import Array, Caller, Check, Failure, Mistake, ModuleChecks, Trial
from course.grading.checks.preparing import KEPT, generator, prepared
from course.grading.checks.result import Status
from course.grading.checks.running import run_checks
from course.grading.checks.trusted import TrustedModule
from course.grading.errors import StudentError

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


class Hangs:
    """A caller none of whose calls ends; it counts them."""

    def __init__(self) -> None:
        self.times = 0

    def call(self, *_: object, **__: object) -> object:
        self.times += 1
        raise StudentError("timeout", "no answer")

    def call_and_look(self, *_: object) -> tuple[object, list[object], bool]:
        raise StudentError("timeout", "no answer")


def test_mistakes_are_not_waited_for_one_after_the_other() -> None:
    caller = Hangs()
    mistakes = tuple(Mistake("it", f"{k}", "", lambda trial: trial.call()) for k in range(5))
    checks = ModuleChecks("module", (Check("it", "value", "It is 2", fails),), mistakes)
    (result,) = run_checks(checks, caller, prepared(MODULE, 0), 0)
    assert (result.status, result.mistake) == (Status.FAILED, "")
    assert caller.times == 1


def calls(trial: Trial) -> None:
    trial.call()


@pytest.mark.parametrize("lent", [True, False])
def test_whoever_stands_below_a_function_that_hangs_is_asked_with_the_reference_first(
    lent: bool,
) -> None:
    own = Hangs()
    checks = ModuleChecks(
        "module",
        tuple(Check(name, f"{k}", "", calls) for name in ("above", "below") for k in range(2)),
        (),
    )
    right = TrustedModule({"below": lambda: 1})
    results = list(
        run_checks(
            checks,
            own,
            prepared(MODULE, 0),
            0,
            lenders=lambda name: right if lent and name == "below" else None,
        )
    )
    assert [result.status for result in results[:2]] == [Status.TIMEOUT] * 2
    expected = Status.PASSED if lent else Status.TIMEOUT
    assert [result.status for result in results[2:]] == [expected] * 2
    # What hangs is waited for once, and what calls it not at all.
    assert own.times == (1 if lent else 2)
