"""What `modules.md`'s conventions ask of every function: shapes, dtypes, inputs untouched, N = 0, finite, ValueError.

Each helper raises ``Failure`` with what was expected and what was found.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Failure, Trial
from course.grading.errors import StudentError


def check_array(value: Any, shape: tuple[int, ...], dtype: Any, what: str = "the result") -> Array:
    """An ndarray of that shape and dtype, every number finite; the array, so that calls nest.

    Raises
    ------
    Failure
    """
    dtype = np.dtype(dtype)
    if type(value) is not np.ndarray:
        raise Failure(f"{what} to be an ndarray", type(value).__name__)
    if value.shape != shape:
        raise Failure(f"{what} of shape {shape}", f"shape {value.shape}")
    if value.dtype != dtype:
        raise Failure(
            f"{what} of dtype {dtype}",
            f"{value.dtype}",
            hint="The result has the dtype of the batch arguments.",
        )
    finite = np.isfinite(value)
    if not finite.all():
        index = tuple(int(i) for i in np.argwhere(~finite)[0])
        raise Failure(f"{what} to be finite", f"{value[index]}", f"at index {index}")
    return value


def check_close(
    value: Array,
    expected: Array,
    tolerance: float,
    what: str = "the result",
    arguments: Callable[[int], str] | None = None,
    hint: str = "",
) -> None:
    """Two arrays agree to an absolute tolerance; the worst column is named.

    Parameters
    ----------
    arguments : says what the arguments were in a column (the last axis)

    Raises
    ------
    Failure
    """
    off = np.abs(np.asarray(value, np.float64) - np.asarray(expected, np.float64))
    if off.size and not off.max() <= tolerance:
        worst = np.unravel_index(int(np.argmax(off)), off.shape)
        where = f"at index {tuple(int(i) for i in worst)}"
        if arguments is not None:
            where += f": {arguments(int(worst[-1]))}"
        raise Failure(
            f"{what} {float(np.asarray(expected)[worst]):.7g} within {tolerance:.2g}",
            f"{float(np.asarray(value)[worst]):.7g}",
            where,
            hint,
        )


def check_untouched(trial: Trial, *arguments: Any) -> None:
    """The function writes to none of its arguments and leaves NumPy's global random state alone.

    Raises
    ------
    Failure
    """
    before = [np.array(a) if isinstance(a, np.ndarray) else a for a in arguments]
    _, after, moved = trial.caller.call_and_look(trial.function, *arguments)
    for number, (old, new) in enumerate(zip(before, after, strict=True)):
        if isinstance(old, np.ndarray) and not np.array_equal(old, new, equal_nan=True):
            raise Failure(
                f"argument {number + 1} to be left as it was",
                "it has been written to",
                hint="Work on a copy.",
            )
    if moved:
        raise Failure(
            "NumPy's global random state to be left alone",
            "the function seeds it or draws from it",
            hint="The random numbers are given: u, or rng.",
        )


def check_refused(trial: Trial, *arguments: Any, named: str) -> None:
    """The function raises ValueError for these arguments.

    Parameters
    ----------
    named : the argument that is wrong, for the report

    Raises
    ------
    Failure
    """
    try:
        trial.call(*arguments)
    except StudentError as error:
        if error.kind == "raised" and error.type == "ValueError":
            return
        raise
    raise Failure(
        f"ValueError for a wrong {named}",
        "no error",
        hint="The checks at the function's top came with the stub.",
    )


def worst_units(rows: int, dtype: Any) -> Array:
    """Every combination of the ends of [0, 1), of their neighbours and of the middle, a column each."""
    dtype = np.dtype(dtype)
    one = dtype.type(1)
    ends = [
        0.0,
        float(np.finfo(dtype).tiny),
        0.5,
        1 - 2.0**-24,
        float(np.nextafter(one, dtype.type(0))),
    ]
    return np.array(np.meshgrid(*[ends] * rows, indexing="ij"), dtype).reshape(rows, -1)


def at(**arguments: Array) -> Callable[[int], str]:
    """Says what the arguments were in a column: ``u = (0.25, 0.5)``."""

    def say(column: int) -> str:
        return ", ".join(
            f"{name} = {_shown(array[..., column])}" for name, array in arguments.items()
        )

    return say


def _shown(values: Array) -> str:
    numbers: Sequence[float] = np.ravel(values).tolist()
    text = ", ".join(f"{number:.6g}" for number in numbers)
    return f"({text})" if np.ndim(values) else text
