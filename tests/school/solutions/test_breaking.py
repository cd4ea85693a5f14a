"""Every function of the solutions, broken in one convention at a time: the declared check of it sees it."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest

from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.conventions import conventions
from course.school.grading.checks.declare import Function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.trusted import TrustedModule
from course.school.grading.errors import StudentError
from tests.school.solutions.contract import SOLUTIONS, named
from tests.school.solutions.test_conventions import FUNCTIONS

Solution = Callable[..., Any]


def each(value: Any, change: Callable[[Array], Any]) -> Any:
    """Results, each of them changed."""
    return tuple(map(change, value)) if isinstance(value, tuple) else change(value)


def held(given: tuple[Any, ...]) -> list[Array]:
    """Arrays among the arguments, and within them, that have numbers."""
    parts = (part for v in given for part in (v if isinstance(v, tuple | list) else (v,)))
    return [part for part in parts if isinstance(part, np.ndarray) and part.ndim]


def other_dtype(array: Any) -> Any:
    kind = np.asarray(array).dtype
    return np.asarray(array).astype({"f4": "f8", "f8": "f4"}.get(kind.str[1:], "c16"))


def dtype(solve: Solution, *given: Any) -> Any:
    return each(solve(*given), other_dtype)


def shape(solve: Solution, *given: Any) -> Any:
    return each(solve(*given), lambda array: np.asarray(array)[None])


def no_columns(solve: Solution, *given: Any) -> Any:
    if not all(array.size for array in held(given)):
        raise IndexError("no columns")
    return solve(*given)


def writes(solve: Solution, *given: Any) -> Any:
    value = solve(*given)
    for array in held(given):
        array += np.ones((), array.dtype)
    return value


def draws(solve: Solution, *given: Any) -> Any:
    np.random.random()  # noqa: NPY002 - the mistake
    return solve(*given)


def needs_to_write(solve: Solution, *given: Any) -> Any:
    if not all(array.flags.writeable for array in held(given)):
        raise ValueError("assignment destination is read-only")
    return solve(*given)


def takes_memory_as_it_lies(solve: Solution, *given: Any) -> Any:
    laid = all(array.flags.c_contiguous for array in held(given))
    return each(
        solve(*given), lambda array: array if laid else ~array if array.dtype == bool else array + 1
    )


def columns_together(solve: Solution, *given: Any) -> Any:
    def mixed(array: Array) -> Array:
        # A code of 8 bits has no room for the sizes of large batches.
        size = array.size % 251
        return ~array if array.dtype == bool and array.size % 3 == 0 else array + size

    return each(solve(*given), mixed)


def far_off(solve: Solution, *given: Any) -> Any:
    return each(solve(*given), lambda array: 2 * array + 3)


KEPT: dict[Any, Array] = {}


def hands_out_again(solve: Solution, *given: Any) -> Any:
    def kept(array: Array) -> Array:
        same = KEPT.setdefault((solve, array.shape, array.dtype), array)
        same[...] = array
        return same

    return each(solve(*given), kept)


def refuses_nothing(solve: Solution, *given: Any) -> Any:
    try:
        return solve(*given)
    except ValueError:
        return np.zeros(3)


BREAKS = {
    "contract": (dtype, shape, no_columns),
    "untouched": (writes, draws, hands_out_again),
    "at_the_ends": (far_off,),
    "layouts": (needs_to_write, takes_memory_as_it_lies),
    "columns": (columns_together,),
    "refuses": (refuses_nothing,),
}


def has(function: Function, break_: Callable[..., Any]) -> bool:
    """True for a function that can be broken so."""
    a = function.make(Draw(np.random.default_rng(0), 5))
    none = function.make(Draw(np.random.default_rng(0), 0))
    if break_ in (dtype, writes, needs_to_write):
        return bool(held(tuple(a.values())))
    if break_ is hands_out_again:
        return function.columns and "u" in a and all(result.sizes for result in function.results)
    if break_ is takes_memory_as_it_lies:
        return any(array.ndim > 1 for array in held(tuple(a.values())))
    if break_ is no_columns:
        return not all(array.size for array in held(tuple(none.values())))
    return True


@FUNCTIONS
def test_a_broken_convention_is_seen(module: str, function: Function) -> None:
    solve = SOLUTIONS.function(module, function.name)
    for law in conventions(function):
        for break_ in BREAKS[law.name]:
            if has(function, break_):
                broken = partial(break_, solve)
                trial = Trial(
                    function.name,
                    TrustedModule({function.name: broken}),
                    np.random.default_rng(7),
                )
                # Only what raises itself may end in anything but a verdict.
                raises = break_ in (no_columns, needs_to_write)
                with (
                    named(f"{law.name}: {break_.__name__}"),
                    pytest.raises(StudentError if raises else Failure),
                ):
                    law.run(function, trial)
