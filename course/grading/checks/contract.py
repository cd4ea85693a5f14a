"""What the course's conventions ask of every function: shapes, dtypes, inputs untouched, N = 0, finite, ValueError.

A helper that checks raises ``Failure`` with what was expected and what was found.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course.grading.checks.check import Array, Check, Failure, Trial
from course.grading.errors import StudentError

DTYPES = (np.float32, np.float64)
"""Of the batch arguments, each tried in turn."""

OF_THE_BATCH = "The result has the dtype of the batch arguments."


def contract_checks(
    function: str,
    contract: Callable[[Trial], None],
    untouched: Callable[[Trial], None],
    refuses: Callable[[Trial], None],
) -> tuple[Check, ...]:
    """The three checks of a function's conventions."""
    return tuple(
        Check(function, name, title, run, "contract")
        for name, title, run in (
            ("contract", "Shapes and dtypes are as agreed, and all numbers finite", contract),
            ("untouched", "Arguments and the global random state are left alone", untouched),
            ("refuses", "Wrong arguments raise ValueError", refuses),
        )
    )


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
            hint=OF_THE_BATCH,
        )
    finite = np.isfinite(value)
    if not finite.all():
        index = tuple(int(i) for i in np.argwhere(~finite)[0])
        raise Failure(f"{what} to be finite", f"{value[index]}", f"at index {index}")
    return value


def finite_floats(
    value: Any, shape: tuple[int, ...], what: str = "the result", kinds: str = "f"
) -> Array:
    """An ndarray of that shape and of any floating dtype, every number finite, in float64.

    Which of the dtypes it is, is the business of the check of the contract and fails nothing else.

    Parameters
    ----------
    kinds : of dtypes that pass, by NumPy's letters

    Raises
    ------
    Failure
    """
    dtype = getattr(value, "dtype", np.dtype(float))
    if dtype.kind not in kinds:
        raise Failure(f"{what} to be floating", f"dtype {dtype}", hint=OF_THE_BATCH)
    return np.asarray(check_array(value, shape, dtype, what), np.float64)


def finite_numbers(value: Any, shape: tuple[int, ...], what: str = "the result") -> Array:
    """The same for an ndarray of any real dtype, whole numbers included.

    Raises
    ------
    Failure
    """
    return finite_floats(value, shape, what, kinds="fiu")


def pair(value: Any, first: str, second: str) -> tuple[Any, Any]:
    """Two results, of whatever kind, called so in the report.

    Raises
    ------
    Failure
    """
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise Failure(f"two results: {first}, {second}", type(value).__name__)
    return value[0], value[1]


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


def near(found: Any, expected: Any, tolerance: float = 1e-3) -> bool:
    """Two arrays agree to an absolute tolerance: for mistakes, of which it is asked whether they are made."""
    return bool(np.abs(np.asarray(found, np.float64) - expected).max() < tolerance)


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


def check_seeded(
    trial: Trial, draw: Callable[[np.random.Generator], Array], what: str = "points"
) -> None:
    """What the function draws is told by the generator that is handed in.

    Parameters
    ----------
    draw : calls the function with a generator

    Raises
    ------
    Failure
    """
    seed = int(trial.rng.integers(2**62))
    first, again, other = (draw(np.random.default_rng(s)) for s in (seed, seed, seed + 1))
    if not np.array_equal(first, again):
        raise Failure(
            f"the same {what} from generators with the same seed",
            f"other {what}",
            hint="All random numbers come from the generator that is handed in.",
        )
    if np.array_equal(first, other):
        raise Failure(
            f"other {what} from a generator with another seed",
            f"the same {what}",
            hint="The generator that is handed in has to be used.",
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
