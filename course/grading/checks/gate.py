"""Between a student's functions and a check: no value reaches a check that isn't of the kind the contract says."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.grading.checks.check import Caller
from course.grading.checks.declarations import declaration
from course.grading.checks.declare import Arguments, Function, unstacked
from course.grading.checks.examples import where
from course.grading.errors import StudentError
from course.grading.worker.wording import said, told

COMMA = "A comma after the only result makes a tuple of it."


class Gate:
    """A ``Caller`` that lets no value through that a check could stumble over.

    The kind of each result is looked at, how many there are, their shape where the engine counts on it, and whether
    all numbers are finite. Which dtype they have is the business of the checks of the contract.

    Parameters
    ----------
    module : whose functions are called; those of all modules together are called MODULE.NAME
    caller : calls them

    Attributes
    ----------
    last : what the last call gave, and for which arguments
    """

    def __init__(self, module: str, caller: Caller) -> None:
        self._module, self._caller = module, caller
        self.last = "nothing was called"

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        """The function's value.

        Raises
        ------
        StudentError
            There is none, or ("bad value") it is not of the kind that it should be.
        """
        value = self._caller.call(function, *arguments, **named)
        value = self._unstacked(function, value)
        self._look(function, value, arguments, named)
        return value

    def call_and_look(self, function: str, *arguments: Any) -> tuple[Any, list[Any], bool]:
        """The value, the arguments afterwards, and whether NumPy's global random state moved; raises the same."""
        value, after, moved = self._caller.call_and_look(function, *arguments)
        value = self._unstacked(function, value)
        self._look(function, value, arguments, {})
        return value, after, moved

    def _unstacked(self, function: str, value: Any) -> Any:
        declared = declaration(*self._path(function).split(".", 1))
        return unstacked(value, len(declared.results)) if declared else value

    def _path(self, function: str) -> str:
        return function if "." in function else f"{self._module}.{function}"

    def _look(
        self, function: str, value: Any, arguments: tuple[Any, ...], named: dict[str, Any]
    ) -> None:
        path = self._path(function)
        declared = declaration(*path.split(".", 1))
        given = said(path, arguments, named)
        self.last = f"{function} returned {told(value)} for {given or 'no arguments'}"
        if declared is None:
            return
        several = isinstance(value, tuple | list)
        parts = value if several else (value,)
        count = len(declared.results)
        if several != (count > 1) or len(parts) != count:
            wanted = f"{count} results" if count > 1 else "one array or number"
            raise StudentError(
                "bad value",
                f"{function} returned {told(value)} instead of {wanted}",
                arguments=given,
                remedy=COMMA if count == 1 and len(parts) == 1 else "",
            )
        shapes = None if named else declared.shapes(arguments)
        for number, part in enumerate(parts):
            shape = shapes[number] if shapes else None
            wrong = _wrong(part, shape, declared.results[number].finite)
            if wrong:
                error = StudentError("bad value", f"{function} returned {wrong}", arguments=given)
                error.example = _column(declared, part, arguments)
                raise error


def _column(declared: Function, part: Any, arguments: tuple[Any, ...]) -> str:
    """The arguments of a number that isn't finite; empty if all are."""
    array = np.asarray(part)
    if array.dtype.kind != "f" or np.isfinite(array).all():
        return ""
    names = (argument.name for argument in declared.arguments)
    index = tuple(map(int, np.argwhere(~np.isfinite(array))[0]))
    return where(Arguments(zip(names, arguments, strict=False)), index, array.shape)


def _wrong(part: Any, shape: tuple[int, ...] | None, finite: bool) -> str:
    """What is wrong with one result; empty if nothing is."""
    if not isinstance(part, np.ndarray | np.generic | bool | int | float):
        return f"{told(part)} instead of numbers"
    array = np.asarray(part)
    if array.dtype.kind not in "fiub":
        return f"an array of {array.dtype} instead of numbers"
    if shape and (array.shape != shape or not isinstance(part, np.ndarray)):
        return f"{told(part)} instead of an array of shape {shape}"
    if not finite or np.isfinite(array).all():
        return ""
    index = tuple(map(int, np.argwhere(~np.isfinite(array))[0]))
    return f"numbers that are not finite: {array[index]}" + (f" at index {index}" if index else "")
