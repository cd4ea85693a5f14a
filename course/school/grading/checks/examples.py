"""What a report says of the arguments: those of the worst column, and the smallest input that shows a mistake."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from course.school.grading.checks.bounds import Bounded
from course.school.grading.checks.check import Failure, Trial
from course.school.grading.checks.declare import Arguments, Case, Function, Law
from course.school.grading.checks.drawing import Draw
from course.school.grading.errors import StudentError

TRIES = 6
"""Small inputs of each size that are tried."""

SMALL = (1, 2, 3)
"""Columns."""


def where(a: Arguments, index: tuple[Any, ...], shape: tuple[int, ...]) -> str:
    """The arguments that an element of a result was made from: of batches their column, of others all.

    Parameters
    ----------
    index : of the element, the column last
    shape : of what it is an element of
    """
    column = int(index[-1]) if index else 0
    columns = shape[-1] if shape else 0
    parts = [
        f"{name} = {_of(value, column, columns)}"
        for name, value in a.items()
        if not isinstance(value, np.random.Generator)
    ]
    return ", ".join(parts)


def example(
    function: Function,
    trial: Trial,
    failure: Failure,
    look: Callable[[Arguments, Any], None],
    case: Case | None,
) -> None:
    """Give a failure the smallest input that breaks the law: up to three columns of round numbers, if there is one."""
    from course.school.grading.checks.laws import exact

    rng, trial = np.random.default_rng(0), replace(trial, caller=Bounded(trial.caller))
    for n in SMALL:
        for _ in range(TRIES):
            try:
                a = function.make(Draw(rng, n, np.float64, simple=True), case)
                value = function.call(trial, a)
                look(exact(a), value)
            except Failure as small:
                failure.example = (
                    f"{call(function.name, a)}: expected {small.expected}, came {small.found}"
                )
                return
            except StudentError:
                return
            except Exception:  # noqa: BLE001 - a law need not hold together for so few columns
                continue
    failure.example = failure.where


def fewest_columns(function: Function, law: Law, trial: Trial) -> str:
    """The smallest call, of the arguments that a law is about, that gives no usable value; empty if few columns do."""
    caller = Bounded(trial.caller)
    for n in SMALL:
        rng = np.random.default_rng(n)
        small = Trial(trial.function, caller, rng, trial.references)
        a = function.make(Draw(rng, n, np.float64, simple=True), law.case)
        try:
            function.call(small, a)
        except Failure as failure:
            return f"{call(function.name, a)}: expected {failure.expected}, came {failure.found}"
        except StudentError as error:
            if error.kind not in ("raised", "bad value"):
                return ""
            told = f"{error.type}: {error}" if error.kind == "raised" else str(error)
            return f"{call(function.name, a)}: expected a value, came {told}"
    return ""


def call(name: str, a: Arguments) -> str:
    """A call as one would write it, for few columns."""
    return f"{name}({', '.join(f'{key} = {_whole(value)}' for key, value in a.items())})"


def _whole(value: Any) -> str:
    if isinstance(value, np.random.Generator):
        return "a generator"
    if isinstance(value, tuple):
        return f"({', '.join(map(_whole, value))})"
    if isinstance(value, np.ndarray):
        text = np.array2string(value, separator=", ", formatter={"float_kind": _entry})
        return " ".join(text.split()) if value.size <= 36 else f"an array {value.shape}"
    if isinstance(value, np.generic):
        # A call that is pasted has to be the same call: a scalar of NumPy's isn't Python's float.
        return f"np.{value.dtype}({number(value)})"
    return number(value) if isinstance(value, float) else str(value)


def _of(value: Any, column: int, columns: int) -> str:
    if isinstance(value, tuple):
        return f"{len(value)} arrays"
    if isinstance(value, np.ndarray) and value.ndim:
        axes = [axis for axis, size in enumerate(value.shape) if size == columns > 0]
        if axes:
            value = value.take(column, axes[-1])
        numbers = np.ravel(value)
        if numbers.size > 12:
            return f"an array {value.shape}"
        text = ", ".join(map(number, numbers.tolist()))
        return f"({text})" if np.ndim(value) else text
    return number(value) if isinstance(value, float) else str(value)


def _entry(value: Any) -> str:
    """A number of a floating array, which stays one when it is pasted."""
    text = number(value, 4)
    return f"{text}." if text.lstrip("-").isdigit() else text


def told_apart(one: Any, other: Any, digits: int = 7) -> tuple[str, str]:
    """Two numbers with as many digits as tell them apart, so many at least."""
    for more in (digits, 9, 12, 17):
        texts = number(one, more), number(other, more)
        if texts[0] != texts[1] or one == other:
            break
    return texts


def number(value: Any, digits: int = 6) -> str:
    """A number to be read; what is next to 1, as the largest numbers u are, is not shown as 1."""
    text = f"{value:.{digits}g}"
    if text == "1" and value != 1:
        return f"1 {'-' if value < 1 else '+'} {abs(value - 1):.2g}"
    return text
