"""Where NumPy's own loops of sines, logarithms and the like begin, for float32 arrays.

They are public in the C structure of a ufunc (NumPy's ``ufuncobject.h``, ``PyUFuncObject``).
"""

import ctypes
from functools import cache
from typing import Any

import numpy as np

_FUNCTIONS, _DATA = 32, 40
"""Where a ufunc has the table of its loops, and of what they are handed, in bytes from its beginning."""

OF_ONE = ("sin", "cos", "log", "exp", "log1p", "expm1", "cbrt")
OF_TWO = ("arctan2", "hypot")


@cache
def loops() -> dict[str, tuple[int, int]] | None:
    """Of each function the address of its loop, and of what that is handed, 0 for nothing.

    None if one of them isn't as in the NumPy that this was written for.
    """
    found = {name: _loop(getattr(np, name), "f->f") for name in OF_ONE}
    found |= {name: _loop(getattr(np, name), "ff->f") for name in OF_TWO}
    known = {name: loop for name, loop in found.items() if loop is not None}
    if len(known) < len(found) or any(known[name][1] for name in OF_ONE):
        return None
    return known


def _loop(ufunc: Any, kind: str) -> tuple[int, int] | None:
    if kind not in ufunc.types or ctypes.sizeof(ctypes.c_void_p) != 8:
        return None
    table, data = _pointer(id(ufunc) + _FUNCTIONS), _pointer(id(ufunc) + _DATA)
    entry = 8 * ufunc.types.index(kind)
    if table is None or data is None:
        return None
    address = _pointer(table + entry)
    return None if address is None else (address, _pointer(data + entry) or 0)


def _pointer(address: int) -> int | None:
    return ctypes.c_void_p.from_address(address).value
