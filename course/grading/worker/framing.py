"""Messages between the grader and a worker: a JSON head, then arrays as .npy; pickling is off at both ends.

This file runs on both sides and so needs nothing but the standard library and NumPy. A message is

    8 hexadecimal digits: length of the head      the head, JSON
    for each array: 8 hexadecimal digits: length  the array, .npy

and values in the head are {"array": number}, {"rng": state}, {"tuple": [...]} or {"value": number, text or None}.
"""

from __future__ import annotations

import io
import json
import math
from collections.abc import Callable
from typing import Any

import numpy as np

LARGEST = 1 << 28
"""Bytes of one part of a message; what claims to be larger is no message."""


class BrokenMessage(Exception):  # noqa: N818 - the end of a conversation, not a fault of this program
    """What came through the pipe is no message."""


def pack(head: dict[str, Any], values: list[Any]) -> bytes:
    """A message of a head and values.

    Raises
    ------
    TypeError
        A value is neither an array of numbers nor a number, text, None, generator or a tuple of such.
    """
    arrays: list[bytes] = []
    described = [_describe(value, arrays) for value in values]
    text = json.dumps(head | {"values": described, "arrays": len(arrays)}).encode()
    return b"".join(b"%08x" % len(part) + part for part in (text, *arrays))


def unpack(read: Callable[[int], bytearray]) -> tuple[dict[str, Any], list[Any]]:
    """The next message: its head and values.

    Parameters
    ----------
    read : gives exactly that many bytes, or raises

    Raises
    ------
    BrokenMessage
    """
    try:
        head = json.loads(bytes(_part(read)))
        arrays = [_array(_part(read)) for _ in range(int(head["arrays"]))]
        return head, [_restore(described, arrays) for described in head["values"]]
    except (ValueError, KeyError, TypeError, IndexError, AttributeError, RecursionError) as error:
        raise BrokenMessage(f"{type(error).__name__}: {error}") from error


def _part(read: Callable[[int], bytearray]) -> bytearray:
    length = int(bytes(read(8)), 16)
    if not 0 <= length <= LARGEST:
        raise BrokenMessage(f"a part of {length} bytes")
    return read(length)


def _describe(value: Any, arrays: list[bytes]) -> dict[str, Any]:
    if isinstance(value, tuple | list):
        return {"tuple": [_describe(item, arrays) for item in value]}
    # Exactly an ndarray, or a scalar of NumPy: a subclass could behave as it likes on this side too.
    if type(value) is np.ndarray or isinstance(value, np.generic):
        if np.asarray(value).dtype.kind not in "fiub":
            raise TypeError(f"an array of {np.asarray(value).dtype} instead of numbers")
        arrays.append(_npy(np.asarray(value)))
        return {"array": len(arrays) - 1, "scalar": isinstance(value, np.generic)}
    if isinstance(value, np.random.Generator):
        return {"rng": _plain(value.bit_generator.state)}
    if value is None or type(value) in (bool, int, float, str):
        return {"value": value}
    raise TypeError(
        f"a {type(value).__module__}.{type(value).__qualname__} instead of numbers or arrays of numbers"
    )


def _plain(state: Any) -> Any:
    if isinstance(state, dict):
        return {key: _plain(value) for key, value in state.items()}
    return state


def _restore(described: dict[str, Any], arrays: list[Any]) -> Any:
    if "tuple" in described:
        return tuple(_restore(item, arrays) for item in described["tuple"])
    if "array" in described:
        array = arrays[described["array"]]
        return array[()] if described.get("scalar") and array.ndim == 0 else array
    if "rng" in described:
        generator = np.random.Generator(np.random.PCG64())
        generator.bit_generator.state = described["rng"]
        return generator
    value = described["value"]
    if value is not None and type(value) not in (bool, int, float, str):
        raise BrokenMessage("a value that is none")
    return value


def _npy(array: Any) -> bytes:
    """The bytes of a .npy file; ``write_array`` gives the same, in more copies."""
    file = io.BytesIO()
    np.lib.format.write_array_header_1_0(file, np.lib.format.header_data_from_array_1_0(array))
    order: Any = "F" if array.flags.f_contiguous and not array.flags.c_contiguous else "C"
    data: bytes = file.getvalue() + array.tobytes(order)
    return data


def _array(data: bytearray) -> Any:
    file = io.BytesIO(data)
    if np.lib.format.read_magic(file) != (1, 0):
        raise BrokenMessage("an array in another version of .npy")
    shape, fortran, dtype = np.lib.format.read_array_header_1_0(file, max_header_size=10_000)
    # Objects are refused here, and nothing is ever unpickled.
    if dtype.kind not in "fiub" or any(size < 0 for size in shape):
        raise BrokenMessage("an array that isn't one of numbers")
    start = file.tell()
    if len(data) - start != math.prod(shape) * dtype.itemsize:
        raise BrokenMessage("an array that is longer or shorter than its shape")
    # Over the bytes that have been read: writable, and no copy.
    flat = np.frombuffer(data, dtype, offset=start)
    return flat.reshape(shape, order="F" if fortran else "C")
