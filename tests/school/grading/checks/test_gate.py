"""Values of the wrong kind reach no check, and earn nothing in any; right ones of every function go through."""

from itertools import cycle
from typing import Any

import numpy as np
import pytest

from course.engine.functions.modules import COURSE
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Caller, Check, ModuleChecks, References
from course.school.grading.checks.result import Status
from course.school.grading.checks.running import Gate, run_checks
from course.school.grading.checks.trusted import TrustedModule
from course.school.grading.errors import StudentError
from course.school.grading.references import reference

RENDERED = [
    (module, check)
    for module in COURSE
    for check in module_checks(module).checks
    if check.kind in ("picture", "bias", "order")
]


class Changed:
    """The reference, of which one function's values come changed."""

    def __init__(self, module: str, function: str, change: Any) -> None:
        self._right, self._function, self._change = reference(module), function, change

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        value = self._right.call(function, *arguments, **named)
        return self._change(value) if function == self._function else value

    def call_and_look(self, function: str, *arguments: Any) -> tuple[Any, list[Any], bool]:
        return self.call(function, *arguments), [*arguments], False


def ended(module: str, check: Check, caller: Caller, references: References) -> Any:
    one = ModuleChecks(module, (check,))
    return next(run_checks(one, caller, references, 0, standard=lambda: reference(module)))


CHANGES = {
    "a tuple of it": lambda value: (value,),
    "a list of it": lambda value: [value],
    "None": lambda _: None,
    "a text": lambda _: "text",
    "one number": lambda _: 0.5,
    "booleans": lambda _: np.zeros((9, 5), bool),
}


@pytest.mark.parametrize(
    ("module", "check", "change"),
    [(*rendered, change) for rendered, change in zip(RENDERED, cycle(CHANGES))],
    ids=lambda value: value if isinstance(value, str) else f"{value.function}-{value.name}",
)
def test_no_picture_bias_or_order_is_earned_by_what_is_no_array(
    module: str, check: Check, change: str, usual_references: References
) -> None:
    """The checks take the kinds of values in turn."""
    changed = Changed(module, check.function, CHANGES[change])
    result = ended(module, check, changed, usual_references)
    assert (result.status, result.points, result.broken) == (Status.FAILED, 0, False)
    assert result.found.startswith(f"{check.function} returned ")


PATHS = [f"{module}.{name}" for module in COURSE for name in COURSE[module]]


def gate(value: Any, path: str = "thin_lens.point_on_disk") -> Gate:
    module, _, name = path.partition(".")
    return Gate(module, TrustedModule({name: lambda *_: value}))


@pytest.mark.parametrize(
    ("value", "says"),
    [
        ((np.zeros((2, 4)),), "a tuple of 1 ((2, 4) float64) instead of one array or number"),
        ([[0.0] * 4] * 2, "a tuple of 2"),
        (np.zeros((4, 2)), "(4, 2) float64 instead of an array of shape (2, 4)"),
        (np.zeros(()), "() float64 instead of an array of shape (2, 4)"),
        (0.5, "0.5 instead of an array of shape (2, 4)"),
        (np.float64(0.5), "0.5 float64 instead of an array of shape (2, 4)"),
        (np.full((2, 4), "x"), "an array of <U1 instead of numbers"),
        (np.full((2, 4), 1j), "an array of complex128 instead of numbers"),
        (np.full((2, 4), None), "an array of object instead of numbers"),
        (None, "None instead of numbers"),
        (np.full((2, 4), np.nan), "numbers that are not finite: nan at index (0, 0)"),
        (np.full((2, 4), -np.inf), "numbers that are not finite: -inf at index (0, 0)"),
        (10**400, "an array of object instead of numbers"),
        (np.str_("x"), "an array of <U1 instead of numbers"),
    ],
)
def test_what_is_of_the_wrong_kind_is_told(value: Any, says: str) -> None:
    u = np.zeros((2, 4), np.float32)
    for ask in (
        lambda: gate(value).call("point_on_disk", u),
        lambda: gate(value).call_and_look("point_on_disk", u),
    ):
        with pytest.raises(StudentError) as error:
            ask()
        assert error.value.kind == "bad value"
        assert str(error.value).startswith(f"point_on_disk returned {says}")
        assert error.value.arguments == "u (2, 4) float32"


@pytest.mark.parametrize("dtype", [bool, np.int8, np.float16, np.float32, np.float64])
def test_the_dtype_is_the_business_of_the_contract(dtype: Any) -> None:
    value = np.ones((2, 4), dtype)
    assert gate(value).call("point_on_disk", np.zeros((2, 4))) is value


def test_as_many_results_as_the_contract_says() -> None:
    ray = np.zeros((3, 4))
    u = (ray[:, 0],) * 4 + (ray, ray[:2], 1.0)
    path = "thin_lens.lens_rays"
    assert gate((ray, ray), path).call("lens_rays", *u) == (ray, ray)
    for value in (ray, (ray,), (ray, ray, ray), (ray, ray[:2]), (ray, (ray,))):
        with pytest.raises(StudentError):
            gate(value, path).call("lens_rays", *u)


def test_wrong_arguments_are_no_reason_to_look_at_shapes() -> None:
    # The function has to refuse these; that it hasn't is what the check says.
    assert gate(np.zeros(3)).call("point_on_disk", 3.0).shape == (3,)


def test_one_cause_is_one_whatever_the_number_of_columns() -> None:
    causes = set()
    for n in (1, 3, 4096):
        with pytest.raises(StudentError) as error:
            gate(np.zeros((n, 5))).call("point_on_disk", np.zeros((2, n)))
        causes.add(error.value.cause)
    assert len(causes) == 1
