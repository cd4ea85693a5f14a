"""One look at what a student's function returns, before the renderer goes on with it.

Functions of the course's own solutions are held against the same contracts by tests, and are called as they are.
"""

import linecache
import os
import traceback
import warnings
from collections.abc import Callable
from functools import update_wrapper
from inspect import unwrap
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

from course.base.errors import CourseError, CourseWarning, Ended, FunctionError
from course.engine.functions.contracts import Contract, ResultContract, contract
from course.engine.functions.signatures import CONTRACTS
from course.engine.functions.sources import spot

LONGEST_DEVIATION = 1e-3
"""Largest difference of a direction's length from 1: the contract's 1e-5, and some more for the renderer's rounding."""

SHORTEST, LONGEST = (1 - LONGEST_DEVIATION) ** 2, (1 + LONGEST_DEVIATION) ** 2
"""Squares of lengths."""

LARGEST = 1e18
"""Of a number, so that a product of two stays within single precision's range, and no sum of a picture's overflows."""

PASSED = (KeyboardInterrupt, Ended, NotImplementedError, MemoryError, CourseError)
"""Exceptions that are not the function's: it was interrupted, isn't written yet, or there is no room."""


class Guard:
    """A function of a student's that returns what its contract says, or raises FunctionError.

    It can't write into the arrays that are its arguments. Floating arrays arrive as C-contiguous float32 that may be
    written to. Other dtypes of numbers are converted, with one CourseWarning for the function.

    Parameters
    ----------
    name : "module.function"
    function : the student's
    file : where it is
    """

    def __init__(self, name: str, function: Callable[..., Any], file: Path) -> None:
        self._name, self._function, self._file = name, function, file
        self._contract: Contract = contract(name)
        self._warned = False
        update_wrapper(self, function, updated=())

    def __call__(self, *arguments: Any) -> Any:
        """The function's value for these arguments.

        Raises FunctionError: it raised an exception, or returned another kind of value than its contract says.
        """
        try:
            # What a function sets NumPy to do with overflows and zeros is its own business.
            with np.errstate():
                value = self._function(*map(_lent, arguments))
        except PASSED:
            raise
        except BaseException as error:
            raise self._raised(error, arguments) from error
        return self._looked_at(value, arguments)

    def _looked_at(self, value: Any, arguments: tuple[Any, ...]) -> Any:
        results, known = self._contract.results, self._contract.sizes(arguments)
        if self._contract.several:
            return self._list(value, known, results[0], arguments)
        if len(results) == 1:
            return self._array(value, results[0], known, arguments)
        if not isinstance(value, tuple | list | np.ndarray) or len(value) != len(results):
            raise self._error(f"{told(value)}; expected {len(results)} arrays", arguments)
        return tuple(
            self._array(part, result, known, arguments, f"result {number}: ")
            for number, (part, result) in enumerate(zip(value, results, strict=True))
        )

    def _list(
        self, value: Any, known: dict[str, int], result: ResultContract, arguments: tuple[Any, ...]
    ) -> list[Any]:
        count = known["*"]
        if not isinstance(value, tuple | list | np.ndarray) or len(value) != count:
            raise self._error(f"{told(value)}; expected a list of {count} arrays", arguments)
        return [
            self._array(part, result, dict(known), arguments, f"array {number}: ")
            for number, part in enumerate(value)
        ]

    def _array(
        self,
        value: Any,
        result: ResultContract,
        known: dict[str, int],
        arguments: tuple[Any, ...],
        which: str = "",
    ) -> Any:
        shape = result.sized(known)
        called, letters = _DTYPES[result.kind]
        is_array = isinstance(value, np.ndarray)
        if is_array:
            # Matrices and masked arrays calculate otherwise.
            value = np.asarray(value)
            if value.shape != shape:
                # What only the results say, the first one says.
                shape = _settled(shape, value.shape, known)
        if not is_array or value.shape != shape or value.dtype.kind not in letters:
            expected = f"{called} {_written(shape)}"
            raise self._error(f"{which}{told(value)}; expected {expected}", arguments)
        if result.kind in ("bool", "whole"):
            most = known.get(result.below, int(result.below) if result.below.isdigit() else 0)
            if most and value.size and not (value.min() >= 0 and value.max() < most):
                worst = value.min() if value.min() < 0 else value.max()
                expected = f"whole numbers from 0 to {most - 1}"
                raise self._error(
                    f"{which}{told(value)} with {worst}; expected {expected}", arguments
                )
            return value
        wanted = np.dtype(np.float64 if result.dtype is np.float64 else np.float32)
        if value.dtype != wanted:
            self._warn(value.dtype, wanted)
            with np.errstate(all="ignore"):
                value = value.astype(wanted)
        flags = value.flags
        if not (flags.c_contiguous and flags.writeable):
            # The caller may write into what it gets, and a column that is repeated can't be written to.
            value = value.copy(order="C")
        if not _right(value, result.kind):
            raise self._error(f"{which}{told(value)} {_wrong(value, result.kind)}", arguments)
        return value

    def _warn(self, dtype: np.dtype[Any], wanted: np.dtype[Any]) -> None:
        if not self._warned:
            self._warned = True
            with warnings.catch_warnings():
                # A module of a student's may have made errors of all warnings.
                warnings.simplefilter("always", CourseWarning)
                warnings.warn(
                    f"{self._name} ({self._place()}) returned {dtype}, which is converted to {wanted}; "
                    "a result has the dtype of the arguments, or the one that is asked for: see `course check`",
                    CourseWarning,
                    stacklevel=2,
                )

    def _raised(self, error: BaseException, arguments: tuple[Any, ...]) -> FunctionError:
        """The error that tells of an exception, and of the last line of the student's own that led to it."""
        # Python knows a module's file by its whole name, however its folder was given.
        folder = Path(os.path.abspath(self._file)).parent  # noqa: PTH100
        own = [
            step
            for step in traceback.extract_tb(error.__traceback__)
            if Path(step.filename).parent == folder
        ]
        line = ""
        if own:
            name, number = own[-1].filename, own[-1].lineno or 0
            text = linecache.getline(name, number).strip()
            place = spot(name, number, Path(self._file.name))
            # In a program the function's own file is told before.
            named = f"line {number} of {Path(name).name}" if place.endswith(f":{number}") else place
            line = f" in {named}: {text}"
        try:
            said = f": {error}".removesuffix(": ")
        except Exception:  # noqa: BLE001
            # A class of the student's, whose __str__ fails in turn.
            said = ", whose message can't be read"
        return self._fault(f"raised {type(error).__name__}{said}{line}", arguments)

    def _error(self, what: str, arguments: tuple[Any, ...]) -> FunctionError:
        return self._fault(f"returned {what}", arguments)

    def _fault(self, what: str, arguments: tuple[Any, ...]) -> FunctionError:
        names = [name for name, _ in self._contract.arguments]
        came = ", ".join(
            f"{name} {told(value)}" for name, value in zip(names, arguments, strict=False)
        )
        return FunctionError(
            f"{self._name} ({self._place()}) {what} (called with {came})", self._name
        )

    def _place(self) -> str:
        """File and line of the function, as editors know them."""
        code = getattr(unwrap(self._function), "__code__", None)
        if code is None:
            return str(self._file)
        return spot(code.co_filename, code.co_firstlineno, self._file)


def asked_in(frame: FrameType | None) -> str:
    """The function of a student's that a thread is in, and the line where it is; empty where it is in none.

    ``frame``: the innermost of the thread
    """
    call, inner = call_in(frame)
    if call is None:
        return ""
    guard = call.f_locals["self"]
    own = next((o for o in inner if not _is_librarys(o.f_code.co_filename)), inner[-1])
    return f"{guard._name} ({spot(own.f_code.co_filename, own.f_lineno, guard._file)})"


def call_in(frame: FrameType | None) -> tuple[FrameType | None, list[FrameType]]:
    """The call of a student's function that a thread is in, and the frames within it; None where it is in none.

    ``frame``: the innermost of the thread
    """
    inner: list[FrameType] = []
    while frame is not None:
        if frame.f_code is Guard.__call__.__code__ and inner:
            return frame, inner
        inner.append(frame)
        frame = frame.f_back
    return None, inner


def _is_librarys(file: str) -> bool:
    return "site-packages" in file or file.startswith((os.path.dirname(os.__file__), "<"))  # noqa: PTH120


def _lent(argument: Any) -> Any:
    """An argument that can't be written into, for the renderer goes on with it."""
    if not isinstance(argument, np.ndarray):
        return argument
    view = argument.view()
    view.flags.writeable = False
    return view


def guarded(name: str, function: Callable[..., Any], file: Path) -> Callable[..., Any]:
    """The function, guarded if the renderer calls it; see ``Guard`` for the parameters."""
    return Guard(name, function, file) if name in CONTRACTS else function


_DTYPES = {
    **dict.fromkeys(("", "infinite", "unbounded"), ("float32", "fiu")),
    "unit": ("float32 unit directions", "fiu"),
    "whole": ("whole numbers", "iu"),
    "bool": ("bool", "b"),
}
"""The name of each kind, and the letters of its dtypes in NumPy."""

_ILLEGAL: dict[str, Callable[[Any], Any]] = {
    "infinite": lambda a: ~(a > -np.inf),
    "unbounded": np.isnan,
}
"""Which numbers of an array are wrong, of the kinds that may have infinities."""


def _settled(
    shape: tuple[int | str, ...], found: tuple[int, ...], known: dict[str, int]
) -> tuple[int | str, ...]:
    """The shape, with sizes that nobody knew as they are found; as it was, where it has other axes."""
    if len(shape) != len(found):
        return shape
    return tuple(
        known.setdefault(word, size) if isinstance(word, str) else word
        for word, size in zip(shape, found, strict=True)
    )


def _right(array: Any, kind: str) -> bool:
    """Whether all numbers of an array are those of its kind; in few passes, for reading it is what this costs."""
    if array.size == 0:
        return True
    if kind == "unit":
        with np.errstate(over="ignore"):
            squares = np.einsum("ij,ij->j", array, array)
        # Both are not numbers where any is none, and no comparison with them is true.
        low, high = squares.min(), squares.max()
        return bool(low >= SHORTEST and high <= LONGEST)
    if kind in _ILLEGAL:
        return not _ILLEGAL[kind](array.min())
    with np.errstate(over="ignore", invalid="ignore"):
        # One pass takes two thirds of the time of two. Where the sum is large, each number is looked at.
        total = np.einsum("i->", array.reshape(-1))
    return bool(abs(total) < LARGEST) or bool(array.min() > -LARGEST and array.max() < LARGEST)


def _wrong(array: Any, kind: str) -> str:
    """The first number or direction of an array that is not right."""
    if kind == "unit":
        length = np.sqrt(np.square(array.astype(np.float64)).sum(axis=0))
        column = int(np.argmax(~(np.abs(length - 1) <= LONGEST_DEVIATION)))
        numbers = ", ".join(f"{number:g}" for number in array[:, column])
        return (
            f"whose column {column} is ({numbers}), of length {length[column]:g}; expected length 1"
        )
    bad = _ILLEGAL.get(kind, lambda a: ~np.isfinite(a))(array)
    expected = "finite numbers"
    if not bad.any():
        bad, expected = np.abs(array) >= LARGEST, f"numbers below {LARGEST:g}"
    index = tuple(int(i) for i in np.argwhere(bad)[0])
    return f"with {array[index]} at index {index}; expected {expected}"


def told(value: Any) -> str:
    """A value's dtype and shape, or the number that it is."""
    if isinstance(value, np.ndarray):
        return f"{value.dtype} {value.shape}"
    if isinstance(value, bool | int | float | np.number | np.bool_):
        return f"{value:g}" if not isinstance(value, bool | np.bool_) else str(value)
    if isinstance(value, tuple | list) and len(value) <= 5:
        return f"a {type(value).__name__} of ({', '.join(map(told, value))})"
    return f"a {type(value).__name__}"


def _written(shape: tuple[int | str, ...]) -> str:
    return f"({', '.join(map(str, shape))}{',' * (len(shape) == 1)})"
