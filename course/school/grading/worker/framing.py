"""Messages between the grader and a worker: a JSON head that describes all values, then the bytes of the arrays.

This file runs on both sides and so needs nothing but the standard library and NumPy. A message is

    8 hexadecimal digits: length of the head      the head, JSON      the bytes of each array, one after the other

with "arrays" in the head: [{"dtype": "float32", "shape": [3, 5], "layout": "C", "frozen": false}, ...], and "values",
each {"array": number}, {"rng": state}, {"tuple": [...]} or {"value": number, text or None}. Nothing is unpickled or
evaluated, and what a message may hold is known from its head, before any of the rest is read.
"""

import json
import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Literal

import numpy as np

LARGEST_HEAD = 1 << 20
LARGEST = 1 << 24
"""Bytes of a head, and of all arrays of a message together; those of the checks have 7 MB at the most."""

MOST_ARRAYS = 4096
DEEPEST = 8
"""Arrays of a message, and tuples in each other; a hierarchy of boxes is five arrays in one tuple."""

LARGEST_INTEGER = 1 << 64

DTYPES = {
    np.dtype(name).name: np.dtype(name)
    for name in (
        *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)),
        *("bool", "float16", "float32", "float64", "longdouble"),
    )
}
"""All that an array may be of, by name."""


class BrokenMessage(Exception):  # noqa: N818 - the end of a conversation, not a fault of this program
    """The bytes that came through the pipe are no message."""


class Passed:
    """A generator's state as a worker has sent it: the grader looks at none and only hands it on.

    ``state``: of a bit generator, JSON
    """

    def __init__(self, state: Any) -> None:
        self.state = state


def pack(head: dict[str, Any], values: list[Any]) -> bytes:
    """A message of a head and values.

    Raises TypeError: a value is neither an array of numbers nor a number, text, None, generator or a tuple of such; or
    there is more of it than a message takes.
    """
    arrays: list[Any] = []
    described = [_describe(value, arrays, 0) for value in values]
    size = sum(array.nbytes for array in arrays)
    if size > LARGEST or len(arrays) > MOST_ARRAYS:
        raise TypeError(
            f"{len(arrays)} arrays of {size:,} bytes; at most {MOST_ARRAYS} of {LARGEST:,} are taken"
        )
    about = [
        {
            "dtype": array.dtype.name,
            "shape": array.shape,
            "layout": _layout(array),
            "frozen": not array.flags.writeable,
        }
        for array in arrays
    ]
    text = json.dumps(head | {"values": described, "arrays": about}).encode()
    if len(text) > LARGEST_HEAD:
        raise TypeError("too many numbers that are in no array, or too long a text")
    return b"".join(
        (
            b"%08x" % len(text),
            text,
            *(array.tobytes("F" if _layout(array) == "F" else "C") for array in arrays),
        )
    )


def unpack(
    read: Callable[[int], bytearray], *, generators: bool = True
) -> tuple[dict[str, Any], list[Any]]:
    """The next message: its head and values.

    Raises BrokenMessage: whatever is wrong with it.

    Parameters
    ----------
    read : gives exactly that many bytes, or raises what its caller knows
    generators : whether to make generators of their states, and arrays of the memory layout that they had; if not,
        states come as ``Passed``, and arrays are contiguous and writable
    """
    prefix = read(8)
    with _decoding():
        length = int(bytes(prefix), 16)
        _expect(0 <= length <= LARGEST_HEAD, f"its head has {length} bytes")
    text = read(length)
    with _decoding():
        head, described, about = _head(bytes(text))
    arrays = []
    for dtype, shape, layout, frozen in about:
        data = read(math.prod(shape) * dtype.itemsize)
        with _decoding():
            # Over the bytes that have been read: writable, and no copy.
            array = _array(np.ndarray(shape, dtype, data, order="F" if layout == "F" else "C"))
            arrays.append(_laid_out(array, layout, frozen) if generators else array)
    with _decoding():
        return head, [_restore(one, arrays, generators, 0) for one in described]


def generator(passed: Any) -> np.random.Generator:
    """The generator whose state has come back, where one was sent; ``BrokenMessage`` if it is none."""
    _expect(type(passed) is Passed, "a generator that went has not come back")
    with _decoding():
        return _generator(passed.state)


@contextmanager
def _decoding() -> Iterator[None]:
    """Whatever goes wrong in reading what a stranger has written, the message is broken and nothing else is."""
    try:
        yield
    except BrokenMessage:
        raise
    except Exception as error:
        raise BrokenMessage(f"{type(error).__name__}: {str(error)[:200]}") from error


def _expect(right: bool, otherwise: str) -> None:
    if not right:
        raise BrokenMessage(otherwise)


Layout = Literal["C", "F", "scattered"]
"""Rows together, columns together, or neither."""

_LAYOUTS: tuple[Layout, ...] = ("C", "F", "scattered")

_About = tuple["np.dtype[Any]", tuple[int, ...], Layout, bool]


def _head(text: bytes) -> tuple[dict[str, Any], list[Any], list[_About]]:
    """The head, what it says of the values, and dtype, shape and layout of the arrays that follow."""
    head = json.loads(text)
    _expect(type(head) is dict, "its head is no object")
    described, listed = head.pop("values"), head.pop("arrays")
    _expect(type(described) is list and type(listed) is list, "its head lists no values")
    _expect(all(map(_is_simple, head.values())), "its head says what no head says")
    _expect(len(listed) <= MOST_ARRAYS, f"it has {len(listed)} arrays")
    about: list[_About] = [
        (
            DTYPES[one["dtype"]],
            _shape(one["shape"]),
            _LAYOUTS[_LAYOUTS.index(one["layout"])],
            one["frozen"] is True,
        )
        for one in listed
    ]
    size = sum(math.prod(shape) * dtype.itemsize for dtype, shape, *_ in about)
    _expect(size <= LARGEST, f"its arrays have {size} bytes")
    return head, described, about


def _is_simple(value: Any) -> bool:
    """True for all that a head may hold beside values and arrays: a text, yes or no, or names."""
    return type(value) in (str, bool) or (
        type(value) is list and all(type(name) is str for name in value)
    )


def _shape(sizes: Any) -> tuple[int, ...]:
    _expect(type(sizes) is list and len(sizes) <= 32, "a shape that is none")
    # Bounded one by one: beside a size of 0 the others would be free.
    _expect(
        all(type(size) is int and 0 <= size <= LARGEST for size in sizes), "a shape that is none"
    )
    return tuple(sizes)


def _array(array: Any) -> Any:
    # Other bytes than 0 and 1 would be neither true nor false.
    return array.view(np.uint8).astype(bool) if array.dtype == np.bool_ else array


def _describe(value: Any, arrays: list[Any], depth: int) -> dict[str, Any]:
    if isinstance(value, tuple | list):
        if depth >= DEEPEST:
            raise TypeError("tuples in tuples in tuples without end")
        return {"tuple": [_describe(item, arrays, depth + 1) for item in value]}
    # Exactly an ndarray, or a scalar of NumPy: a subclass could behave as it likes on this side too.
    if type(value) is np.ndarray or isinstance(value, np.generic):
        array = np.asarray(value)
        if array.dtype.name not in DTYPES:
            raise TypeError(f"an array of {array.dtype} instead of numbers")
        arrays.append(array.astype(DTYPES[array.dtype.name], copy=False))
        return {"array": len(arrays) - 1, "scalar": isinstance(value, np.generic)}
    if isinstance(value, np.random.Generator):
        return {"rng": _plain(value.bit_generator.state)}
    if type(value) is Passed:
        return {"rng": value.state}
    if type(value) is int and abs(value) >= LARGEST_INTEGER:
        raise TypeError("a whole number of more than 64 bits")
    if value is None or type(value) in (bool, int, float, str):
        return {"value": value}
    raise TypeError(
        f"a {type(value).__module__}.{type(value).__qualname__} instead of numbers or arrays of numbers"
    )


def _plain(state: Any) -> Any:
    if isinstance(state, dict):
        return {key: _plain(value) for key, value in state.items()}
    return state


def _restore(described: dict[str, Any], arrays: list[Any], generators: bool, depth: int) -> Any:
    _expect(type(described) is dict and depth <= DEEPEST, "a value that is none")
    if "tuple" in described:
        return tuple(_restore(item, arrays, generators, depth + 1) for item in described["tuple"])
    if "array" in described:
        number = described["array"]
        _expect(type(number) is int and 0 <= number < len(arrays), "an array that isn't there")
        array = arrays[number]
        return array[()] if described.get("scalar") and array.ndim == 0 else array
    if "rng" in described:
        state = described["rng"]
        _expect(_is_state(state), "a generator's state that is none")
        return _generator(state) if generators else Passed(state)
    value = described["value"]
    _expect(value is None or type(value) in (bool, int, float, str), "a value that is none")
    _expect(type(value) is not int or abs(value) < LARGEST_INTEGER, "a number of over 64 bits")
    return value


def _is_state(state: Any, depth: int = 0) -> bool:
    """True if it looks like a PCG64's: numbers and names, and one dict of the same in it."""
    if type(state) is not dict or len(state) > 8 or depth > 1:
        return False
    return all(
        _is_state(value, depth + 1)
        if type(value) is dict
        else type(value) is str or (type(value) is int and 0 <= value < 1 << 128)
        for value in state.values()
    )


def _generator(state: Any) -> np.random.Generator:
    generator = np.random.Generator(np.random.PCG64())
    generator.bit_generator.state = state
    return generator


def _layout(array: Any) -> Layout:
    if array.flags.c_contiguous:
        return "C"
    return "F" if array.flags.f_contiguous else "scattered"


def _laid_out(array: Any, layout: Layout, frozen: bool) -> Any:
    """The array as the other side had it: memory that is contiguous along no axis, or that can't be written to."""
    if layout == "scattered":
        wide = np.zeros((*array.shape, 2), array.dtype)
        wide[..., 0] = array
        array = wide[..., 0]
    if frozen:
        array.flags.writeable = False
    return array
