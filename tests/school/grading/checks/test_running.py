"""References are made once, and no fault of a check or of a mistake's description ends the grading."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import (
    Array,
    Caller,
    Check,
    Failure,
    ModuleChecks,
    Trial,
    generator,
)
from course.school.grading.checks.result import Result, Status
from course.school.grading.checks.running import run_checks
from course.school.grading.checks.trusted import TrustedModule
from course.school.grading.errors import StudentError
from course.school.grading.references import KEPT, prepared

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


def test_a_mistake_is_told_with_the_check_that_fails_for_it() -> None:
    checks = telling(lambda caller, _: ("one", "You return 1.") if caller.call("it") == 1 else None)
    (result,) = run_checks(checks, MODULE, prepared(MODULE, 0), 0)
    assert result.status is Status.FAILED
    assert (result.mistake, result.says) == ("one", "You return 1.")


def telling(named: Any) -> ModuleChecks:
    """A check that fails, of a function whose mistakes are told so."""
    prints = check(None, "mistakes")
    return ModuleChecks(
        "module",
        (Check("it", "value", "It is 2", fails),),
        prints={"it": prints},
        named={"it": named},
    )


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
    checks = telling(lambda caller, _: tuple(caller.call("it") for _ in range(5)))
    (result,) = run_checks(checks, caller, prepared(MODULE, 0), 0)
    assert (result.status, result.mistake) == (Status.FAILED, "")
    assert caller.times == 1


def calls(trial: Trial) -> None:
    trial.call()


def test_what_gives_no_value_is_shown_by_the_smallest_call() -> None:
    """Of all checks that follow from a declaration, whatever they call the function with."""
    checks = [
        check
        for check in module_checks("motion_blur").checks
        if check.function == "displacement" and check.kind not in ("picture", "speed")
    ]
    nothing = TrustedModule({"displacement": lambda *_: None})
    kept = ModuleChecks("motion_blur", tuple(checks))
    results = list(run_checks(kept, nothing, prepared(nothing, 0), 0))
    shown = {result.check: result.example for result in results if result.check != "refuses"}
    assert "contract" in shown
    for example in shown.values():
        assert example.startswith("displacement(velocity = [")
        assert "]): expected a value, came displacement returned None" in example


def test_a_time_of_u_0_is_looked_at() -> None:
    def late(open: Any, close: Any, u: Any) -> Any:  # noqa: A002 - the names of the course
        return np.where(u == 0, close, open + (close - open) * u).astype(u.dtype)

    (check,) = (c for c in module_checks("motion_blur").checks if c.name == "inside")
    own = TrustedModule({"shutter_times": late})
    (result,) = run_checks(ModuleChecks("motion_blur", (check,)), own, prepared(own, 0), 0)
    assert result.status is Status.FAILED


@pytest.mark.parametrize("lent", [True, False])
def test_whoever_stands_below_a_function_that_hangs_is_asked_with_the_reference_first(
    lent: bool,
) -> None:
    own = Hangs()
    checks = ModuleChecks(
        "module",
        tuple(Check(name, f"{k}", "", calls) for name in ("above", "below") for k in range(2)),
    )
    right = TrustedModule({"below": lambda: 1})
    results = list(
        run_checks(
            checks,
            own,
            prepared(MODULE, 0),
            0,
            substitutes=lambda name: right if lent and name == "below" else None,
        )
    )
    assert [result.status for result in results[:2]] == [Status.TIMEOUT] * 2
    expected = Status.PASSED if lent else Status.TIMEOUT
    assert [result.status for result in results[2:]] == [expected] * 2
    # What hangs is waited for once, and what calls it not at all.
    assert own.times == (1 if lent else 2)


def looks_inside(trial: Trial) -> None:
    trial.call()["numbers"]


def always_breaks(trial: Trial) -> None:
    trial.call()
    raise IndexError("secret of the check")


def one(run: Callable[[Trial], None], caller: Caller, **options: Any) -> Result:
    checks = ModuleChecks("module", (Check("it", "value", "It is", run, points=2),))
    (result,) = run_checks(checks, caller, prepared(MODULE, 0), 0, **options)
    return result


def told_to_students(result: Result) -> str:
    return f"{result.expected} {result.found} {result.where} {result.hint} {result.says}"


RIGHT = TrustedModule({"it": lambda: {"numbers": 1}})


def test_a_check_that_breaks_on_what_came_back_is_failed_and_says_what_that_was() -> None:
    result = one(looks_inside, MODULE, standard=lambda: RIGHT)
    assert (result.status, result.points, result.broken) == (Status.FAILED, 0, True)
    assert result.found == "it returned 1 for no arguments"
    assert "With the course's own function it doesn't." in result.hint
    assert "TypeError" in result.instructor
    assert "TypeError" not in told_to_students(result)


def test_a_check_that_breaks_with_the_reference_too_pays() -> None:
    result = one(always_breaks, MODULE, standard=lambda: RIGHT)
    assert (result.status, result.points, result.broken) == (Status.GRADER_ERROR, 2, True)
    assert "secret of the check" in result.instructor
    assert "secret" not in told_to_students(result)
    assert "Traceback" not in told_to_students(result)


def test_without_a_solution_a_check_that_breaks_gives_no_points_and_says_so() -> None:
    for run in (looks_inside, always_breaks):
        result = one(run, MODULE)
        assert (result.status, result.points, result.broken) == (Status.FAILED, 0, True)
        assert "a copy without solutions: here it gives no points" in result.hint


def test_what_is_short_for_a_moment_costs_nothing() -> None:
    calls: list[int] = []

    def run(trial: Trial) -> None:
        trial.call()
        calls.append(1)
        if len(calls) == 1:
            raise MemoryError

    assert one(run, MODULE, standard=lambda: RIGHT).status is Status.PASSED


def test_references_that_can_not_be_made_are_nobodys_mistake() -> None:
    def references(*_: object) -> dict[str, Array]:
        raise StudentError("raised", "by the reference")

    checks = ModuleChecks("module", (Check("it", "value", "It is", calls, prepare=lambda *_: {}),))
    (result,) = run_checks(checks, MODULE, references, 0, standard=lambda: RIGHT)
    assert (result.status, result.points) == (Status.GRADER_ERROR, 1)


def test_an_exception_on_the_way_to_a_verdict_ends_no_grading() -> None:
    def standard() -> Caller:
        raise OSError("no disk")

    result = one(looks_inside, MODULE, standard=standard)
    assert (result.status, result.points, result.broken) == (Status.FAILED, 0, True)
