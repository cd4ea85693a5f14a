"""Shapes that the engine counts on, so that a wrong one is the student's trouble and not the renderer's."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.grading.checks.check import Array
from course.grading.checks.declarations import declared_function
from course.grading.checks.declare import unstacked
from course.grading.errors import StudentError

LARGEST = 1e12
"""Beyond any number in the grader's scenes; the engine can square it in float32."""


Shape = tuple[int, ...]


def usable(function: str, value: Any, arguments: tuple[Any, ...]) -> Any:
    """A student's value as the engine may use it: its own copy, in float32, no number larger than LARGEST; or bool.

    A wrong dtype costs where it is checked; here it is made harmless.

    Raises
    ------
    StudentError
        It isn't arrays of finite numbers of the shapes that the contract says.
    """
    declared = declared_function(*function.split("."))
    shapes = declared.shapes(arguments)
    assert shapes is not None
    value = unstacked(value, len(shapes))
    # What a worker sends is a tuple; a function that is called here may return a list as well.
    several = isinstance(value, tuple | list)
    parts = value if several else (value,)
    if len(parts) != len(shapes) or several != (len(shapes) > 1):
        raise StudentError(
            "bad value", f"{function} returned {_told(value)} instead of {_listed(shapes)}"
        )
    for part, shape in zip(parts, shapes, strict=True):
        if type(part) is not np.ndarray or part.dtype.kind not in "fiub" or part.shape != shape:
            raise StudentError(
                "bad value", f"{function} returned {_told(value)} instead of {_listed(shapes)}"
            )
        if not np.isfinite(part).all():
            raise StudentError("bad value", f"{function} returned numbers that are not finite")
    arrays = tuple(
        part.astype(bool, order="C")
        if result.dtype is np.bool_
        else np.clip(_wide(part), -LARGEST, LARGEST).astype(np.float32, order="C")
        for result, part in zip(declared.results, parts, strict=True)
    )
    return arrays if several else arrays[0]


def _wide(part: Array) -> Array:
    """The array, of a dtype that holds LARGEST."""
    holds = part.dtype.kind == "f" and part.dtype.itemsize >= 4
    return part if holds else part.astype(np.float64)


def _told(value: Any) -> str:
    if isinstance(value, tuple | list):
        return "(" + ", ".join(map(_told, value)) + ")"
    return (
        f"an array of shape {value.shape} and dtype {value.dtype}"
        if isinstance(value, np.ndarray)
        else f"a {type(value).__name__}"
    )


def _listed(shapes: tuple[Shape, ...]) -> str:
    return " and ".join(map(str, shapes))
