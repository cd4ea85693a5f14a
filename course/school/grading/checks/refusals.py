"""Wrong arguments of a function, from its declaration, and whether it refuses them."""

from typing import Any

import numpy as np

from course.school.grading.checks.check import Array, Failure, Trial
from course.school.grading.checks.declare import COLUMNS, Argument, Arguments, Function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.examples import call
from course.school.grading.errors import StudentError


def refuses(function: Function, trial: Trial) -> None:
    """Raise ``Failure`` where wrong arguments don't raise ValueError; each argument in turn is wrong."""
    for argument in function.arguments:
        a = function.make(Draw(trial.rng, 4, np.float32))
        for wrong in (*misshapen(function, argument, a[argument.name]), *argument.wrong):
            shown = f"of shape {np.shape(wrong)}" if isinstance(wrong, np.ndarray) else f"{wrong!r}"
            together = {argument.name: wrong}
            if isinstance(wrong, dict):
                together, shown = wrong, ", ".join(f"{k} = {v}" for k, v in wrong.items())
            _refused(function, trial, Arguments(a | together), f"{argument.name} {shown}")


def _refused(function: Function, trial: Trial, a: Arguments, shown: str) -> None:
    expected, hint = (
        f"ValueError for {shown}",
        "The checks at the function's top came with the stub.",
    )
    try:
        trial.call(*a.values())
    except StudentError as error:
        if error.kind == "raised" and error.type == "ValueError":
            return
        # What is no value at all came back nonetheless: it wasn't refused.
        if error.kind != "bad value":
            if error.kind == "raised":
                # Another error that it came to by chance.
                error.expected, error.remedy = expected, hint
            raise
    raise Failure(expected, "no error", call(function.name, a), hint, slip="not-refused")


def misshapen(function: Function, argument: Argument, value: Any) -> list[Array]:
    """Arrays of wrong shapes: an axis less, an axis more, turned, too few rows, too many; columns that don't fit."""
    if not isinstance(value, np.ndarray) or not argument.sizes:
        return []
    shapes = {value.shape[:-1], (1, *value.shape), (*value.shape, 1)}
    if value.ndim == 2:
        shapes.add(value.shape[::-1])
    for axis, word in enumerate(argument.sizes):
        if word.isdigit():
            shapes |= {_but(value.shape, axis, int(word) + step) for step in (-1, 1)}
        elif any(word in other.sizes for other in function.arguments if other is not argument):
            shapes.add(_but(value.shape, axis, value.shape[axis] - 1))
        elif argument.sizes.count(word) > 1:
            shapes.add(_but(value.shape, axis, value.shape[axis] + 1))
    filler = value.ravel()[0] if value.size else 1
    return [
        np.full(shape, filler, value.dtype)
        for shape in sorted(shapes)
        if not _fits(function, argument, shape, value.shape)
    ]


def _but(shape: tuple[int, ...], axis: int, size: int) -> tuple[int, ...]:
    return (*shape[:axis], size, *shape[axis + 1 :])


def _fits(
    function: Function, argument: Argument, shape: tuple[int, ...], legal: tuple[int, ...]
) -> bool:
    """Whether a value of that shape would be legal: sizes that other arguments share must be as they are."""
    if argument.single and shape == tuple(
        size for size, word in zip(legal, argument.sizes, strict=True) if word != COLUMNS
    ):
        return True
    if len(shape) != len(argument.sizes):
        return False
    elsewhere = {
        word for other in function.arguments if other is not argument for word in other.sizes
    }
    own: dict[str, int] = {}
    for word, size, now in zip(argument.sizes, shape, legal, strict=True):
        if word.isdigit() or word in elsewhere:
            if size != now:
                return False
        elif own.setdefault(word, size) != size:
            return False
    return True
