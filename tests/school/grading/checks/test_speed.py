"""Advice on speed: every function is asked with arguments that are legal, and both callers with the same."""

from typing import Any

import numpy as np
import pytest

from course.engine.functions.modules import COURSE
from course.school.grading.catalog import ROUNDS, module_checks
from course.school.grading.checks.check import Check, Trial, generator
from course.school.grading.checks.trusted import TrustedModule
from course.school.grading.errors import StudentError
from course.school.grading.references import reference

CHECKS = [
    (module, check)
    for module in COURSE
    for check in module_checks(module).checks
    if check.kind == "speed"
]
IDS = [f"{module}.{check.function}" for module, check in CHECKS]


class Listening:
    """Passes calls on, and keeps what was asked and what came."""

    def __init__(self, module: str) -> None:
        self._reference = reference(module)
        self.asked: list[tuple[Any, ...]] = []
        self.came: list[Any] = []

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        value = self._reference.call(function, *arguments, **named)
        self.asked.append(arguments)
        self.came.append(value)
        return value

    def call_and_look(self, function: str, *arguments: Any) -> tuple[Any, list[Any], bool]:
        return self._reference.call_and_look(function, *arguments)


@pytest.mark.parametrize(("module", "check"), CHECKS, ids=IDS)
def test_the_reference_takes_the_arguments(module: str, check: Check) -> None:
    trial = Trial(check.function, Listening(module), generator(0, module, check))
    trial.reference_caller = Listening(module)
    check.run(trial)
    for caller in (trial.caller, trial.reference_caller):
        assert isinstance(caller, Listening)
        assert len(caller.came) == ROUNDS
        value = caller.came[0]
        for part in value if isinstance(value, tuple) else (value,):
            assert not np.isnan(part).any()
    for mine, theirs in zip(trial.caller.asked[0], trial.reference_caller.asked[0], strict=True):
        assert mine is theirs


def test_no_function_is_timed_twice_and_none_costs_points() -> None:
    functions = [(module, check.function) for module, check in CHECKS]
    assert len(set(functions)) == len(functions)
    assert not any(check.points for _, check in CHECKS)


def test_what_gives_no_value_does_not_pass_where_there_is_nothing_to_compare_with() -> None:
    def broken(*_: object) -> None:
        raise KeyError

    module, check = CHECKS[0]
    trial = Trial(
        check.function, TrustedModule({check.function: broken}), generator(0, module, check)
    )
    with pytest.raises(StudentError):
        check.run(trial)
