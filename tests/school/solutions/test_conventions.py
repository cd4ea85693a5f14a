"""Every reference solution keeps its declaration: conventions and laws for seeds of their own, and messages in full."""

import inspect
import math
import re

import numpy as np
import pytest

from course.engine.functions.modules import COURSE
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Array, Trial
from course.school.grading.checks.declare import Argument, Arguments, Function, declarations
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.refusals import misshapen
from course.school.grading.references import reference
from tests.school.solutions.contract import SOLUTIONS, named

DECLARED = {name: declarations(name) for name in COURSE}

FUNCTIONS = pytest.mark.parametrize(
    ("module", "function"),
    [
        pytest.param(name, function, id=f"{name}.{function.name}")
        for name, functions in DECLARED.items()
        for function in functions
    ],
)

SEEDS = (101,)
"""FALSE_FAIL of each comparison is stated with each check: together under 1e-4. `make mutants` has further seeds."""


def arrays(a: Arguments) -> list[Array]:
    """Those among the arguments, and within them."""
    parts = (part for v in a.values() for part in (v if isinstance(v, tuple | list) else (v,)))
    return [part for part in parts if isinstance(part, np.ndarray)]


@FUNCTIONS
def test_the_reference_keeps_its_declaration(module: str, function: Function) -> None:
    for check in module_checks(module).checks:
        if check.function == function.name and check.kind not in ("picture", "bias", "speed"):
            for seed in SEEDS:
                with named(f"{check.name}, seed {seed}"):
                    check.run(Trial(check.function, reference(module), np.random.default_rng(seed)))


def test_what_chance_decides_here_fails_a_right_function_once_in_ten_thousand_at_most() -> None:
    stated = sum(check.false_fail for name in DECLARED for check in module_checks(name).checks)
    assert len(SEEDS) * stated < 1e-4


EITHER = {"importance_sampling.estimate-f"}
"""What has one channel or several: any such array has a right shape, for another density."""


def own(function: Function, argument: Argument, value: Array) -> list[int]:
    """Sizes of a value, without those that its argument shares with others; all if it has another number of axes."""
    others = {word for one in function.arguments if one is not argument for word in one.sizes}
    words = argument.sizes if value.ndim == len(argument.sizes) else ("0",) * value.ndim
    return [
        size
        for word, size in zip(words, value.shape, strict=True)
        if word.isdigit() or word not in others
    ]


def written(argument: Argument, legal: Array) -> str:
    """A pattern of the shape that is wanted: where a size is free it is a letter, where it is known a number."""
    pairs = zip(argument.sizes, legal.shape, strict=True)
    sizes = [word if word.isdigit() else rf"([A-Za-z]|{size})" for word, size in pairs]
    of_all = rf"\({', '.join(sizes)}{',' * (len(sizes) == 1)}\)"
    one = ", ".join(size for size in sizes if size.isdigit())
    return rf"\({one},\) or {of_all}" if argument.single and one else of_all


@FUNCTIONS
def test_a_wrong_shape_is_told_by_name_with_what_was_expected_and_what_came(
    module: str, function: Function
) -> None:
    for argument in function.arguments:
        if argument.sizes:
            with named(argument.name):
                wrong_shapes_are_told(module, function, argument)


def wrong_shapes_are_told(module: str, function: Function, argument: Argument) -> None:
    a = function.make(Draw(np.random.default_rng(0), 5))
    call = SOLUTIONS.function(module, function.name)
    wrong = misshapen(function, argument, a[argument.name])
    assert wrong
    for value in wrong:
        with pytest.raises(
            ValueError, match=r"^\w+ must (be a number or )?have shape \(.*, got \("
        ) as caught:
            call(*Arguments(a | {argument.name: value}).values())
        # Where two arguments disagree in a size that they share, either may be named.
        either = f"{module}.{function.name}-{argument.name}" in EITHER and value.ndim < 3
        if (
            own(function, argument, value) != own(function, argument, a[argument.name])
            and not either
        ):
            assert re.match(
                rf"{argument.name} .*{written(argument, a[argument.name])}.* got "
                rf"{re.escape(str(value.shape))}$",
                str(caught.value),
            )


@FUNCTIONS
def test_no_result_shares_memory_with_an_argument(module: str, function: Function) -> None:
    for dtype in (np.float32, np.float64):
        a = function.make(Draw(np.random.default_rng(0), 5, dtype))
        found = SOLUTIONS.function(module, function.name)(*a.values())
        for result in found if isinstance(found, tuple) else (found,):
            assert not any(np.shares_memory(result, value) for value in arrays(a))


@FUNCTIONS
def test_arguments_are_named_in_calls_as_they_are_declared(module: str, function: Function) -> None:
    named = inspect.signature(SOLUTIONS.function(module, function.name)).parameters
    assert [*named] == [argument.name for argument in function.arguments]


RANGES = {
    **dict.fromkeys(("k", "dims"), ">= 1"),
    **dict.fromkeys(("n", "roughness", "exponent", "threshold", "aperture_radius"), ">= 0"),
    **dict.fromkeys(("sigma", "focus_distance", "focal_length", "object_distance"), "> 0"),
    **dict.fromkeys(("open", "close"), "finite and open <= close"),
    "radius": "finite and >= 0",
    "area": "> 0",
    "cone_density-radius": "> 0",
    "heuristic_weights-exponent": ">= 1",
    "level": "> 0 and < 1",
    "glossiness": ">= 0 and < 1",
    "alpha": "from 0.001 to 1",
    "eta": "from 0.1 to 10",
    "leaf_size": "an integer >= 1",
    "base": "an integer >= 2",
    "levels": "an integer from 0 to 15",
    "seed": "from 0 to 2^32 - 1",
    "bins": "an integer from 1 to min(H, W) // 2",
    "hemicube_form_factors-k": "even and >= 2",
    "shooter": "from 0 to 3",
    "stops": "finite",
    **dict.fromkeys(("key", "majorant"), "finite and > 0"),
    "g": "from -0.99 to 0.99",
    "burn": "from 0 to 100",
    "saturation": "finite and >= 0",
}
"""What numbers must be, as messages say it."""

_MESSAGE = re.compile(r"(?P<who>.+) must (be|have) (?P<what>.+?)(, got (?P<came>.+))?")


@FUNCTIONS
def test_a_wrong_value_is_told_by_name_with_what_was_expected_and_what_came(
    module: str, function: Function
) -> None:
    for argument in function.arguments:
        if argument.wrong:
            with named(argument.name):
                wrong_values_are_told(module, function, argument)


def wrong_values_are_told(module: str, function: Function, argument: Argument) -> None:
    name = argument.name
    numbers = [one for one in argument.wrong if isinstance(one, int | float)]
    more = [np.float64(one) for one in numbers] + [-math.inf] * bool(numbers)
    for wrong in (*argument.wrong, *more):
        a = function.make(Draw(np.random.default_rng(0), 4, np.float32))
        given = a | (wrong if isinstance(wrong, dict) else {name: wrong})
        with pytest.raises(ValueError, match=" must ") as caught:
            SOLUTIONS.function(module, function.name)(*given.values())
        told = _MESSAGE.fullmatch(str(caught.value))
        assert told
        assert name in re.findall(r"\w+", told["who"])
        if isinstance(wrong, int | float):
            assert told["what"] == RANGES.get(f"{function.name}-{name}", RANGES[name])
            assert str(wrong) in told["came"].split(" and ")
