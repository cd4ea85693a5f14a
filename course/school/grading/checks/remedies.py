"""What to do about a result that is of no use: a hint to the usual cause, and the column that shows it."""

from typing import Any

import numpy as np

from course.school.grading.checks.declare import Arguments, Function
from course.school.grading.checks.examples import where
from course.school.grading.errors import StudentError

COMMA = "A comma after the only result makes a tuple of it."

NONE = "A function that ends without return gives None: every way through it has to end with `return` and the result."

ROWS = "Several rows become one array by np.stack([x, y, z])."

TURNED = "It is turned over: coordinates are in the first axis, and the columns of the batch in the last."


def of_count(value: Any, count: int) -> str:
    """What to do about a value that isn't so many results; empty where that is not known."""
    if value is None:
        return NONE
    if count != 1 or not isinstance(value, tuple | list):
        return ""
    return COMMA if len(value) == 1 else ROWS


def of_shape(part: Any, shape: tuple[int, ...] | None) -> str:
    """What to do about a result that is none or of another shape; empty where that is not known."""
    if part is None:
        return NONE
    if shape is None or not isinstance(part, np.ndarray) or part.shape == shape:
        return ""
    if part.shape == shape[::-1]:
        return TURNED
    if part.shape[-1:] == shape[-1:]:
        return ""
    return f"The last axis has a column for each ray or point that is asked for: {shape[-1]} here."


def column_of(declared: Function, part: Any, arguments: tuple[Any, ...]) -> str:
    """The arguments of a number that isn't finite; empty if all are."""
    array = np.asarray(part)
    if array.dtype.kind != "f" or np.isfinite(array).all():
        return ""
    names = (argument.name for argument in declared.arguments)
    index = tuple(map(int, np.argwhere(~np.isfinite(array))[0]))
    return where(Arguments(zip(names, arguments, strict=False)), index, array.shape)


def of_no_use(why: str, given: str, remedy: str, example: str) -> StudentError:
    """The error of a value that is of no use. Raise it as it comes: a frame that names its error is held by it."""
    error = StudentError("bad value", why, arguments=given, remedy=remedy)
    error.example = example
    return error
