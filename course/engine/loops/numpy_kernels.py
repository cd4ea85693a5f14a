"""NumPy's own loops of sines, logarithms and the like for compiled code, so that both have the same last bits.

Every library rounds these functions in its own way, and NumPy's way depends on the processor. So compiled loops call
the very function that ``np.sin`` calls for float32 arrays: it is public in the C structure of a ufunc (NumPy's
``ufuncobject.h``, ``PyUFuncObject``), and needs no interpreter lock.
"""

import ctypes
from typing import Any

import llvmlite.binding
import numpy as np
from numba import types
from numpy.typing import NDArray

from course.engine.loops.options import LEAN, njit

_FUNCTIONS, _DATA = 32, 40
"""Where a ufunc has the table of its loops, and of what they are handed, in bytes from its beginning."""

_NAMES = ("sin", "cos", "log", "exp", "log1p", "expm1", "cbrt")


def _pointer(address: int) -> int | None:
    return ctypes.c_void_p.from_address(address).value


def _loop(ufunc: Any) -> int | None:
    """Address of a ufunc's loop for float32; None if it isn't as in the NumPy that this was written for."""
    if "f->f" not in ufunc.types or ctypes.sizeof(ctypes.c_void_p) != 8:
        return None
    table, data = _pointer(id(ufunc) + _FUNCTIONS), _pointer(id(ufunc) + _DATA)
    entry = 8 * ufunc.types.index("f->f")
    if table is None or data is None or _pointer(data + entry) is not None:
        return None
    return _pointer(table + entry)


def _named() -> bool:
    """Let compiled loops find NumPy's by name; false where one of them isn't found."""
    loops = {name: _loop(getattr(np, name)) for name in _NAMES}
    if None in loops.values():
        return False
    for name, address in loops.items():
        llvmlite.binding.add_symbol(f"course_numpy_{name}", address)
    return True


AVAILABLE = _named()

_loop_type = types.void(*[types.uintp] * 4)
_sin = types.ExternalFunction("course_numpy_sin", _loop_type)
_cos = types.ExternalFunction("course_numpy_cos", _loop_type)
_log = types.ExternalFunction("course_numpy_log", _loop_type)
_exp = types.ExternalFunction("course_numpy_exp", _loop_type)
_log1p = types.ExternalFunction("course_numpy_log1p", _loop_type)
_expm1 = types.ExternalFunction("course_numpy_expm1", _loop_type)
_cbrt = types.ExternalFunction("course_numpy_cbrt", _loop_type)


def call_of() -> NDArray[np.int64]:
    """What a call hands over: addresses of argument and result, their number, and the steps between them in bytes."""
    return np.array((0, 0, 0, 4, 4), np.int64)


@njit(**LEAN)
def _prepare(call, values, results):
    call[0], call[1], call[2] = values.ctypes.data, results.ctypes.data, len(values)


@njit(**LEAN)
def sin(call, values, results):
    """``np.sin`` of contiguous float32 values, into results; so are the others."""
    _prepare(call, values, results)
    _sin(call.ctypes.data, call[2:].ctypes.data, call[3:].ctypes.data, 0)


@njit(**LEAN)
def cos(call, values, results):
    """See ``sin``."""
    _prepare(call, values, results)
    _cos(call.ctypes.data, call[2:].ctypes.data, call[3:].ctypes.data, 0)


@njit(**LEAN)
def log(call, values, results):
    """See ``sin``."""
    _prepare(call, values, results)
    _log(call.ctypes.data, call[2:].ctypes.data, call[3:].ctypes.data, 0)


@njit(**LEAN)
def exp(call, values, results):
    """See ``sin``."""
    _prepare(call, values, results)
    _exp(call.ctypes.data, call[2:].ctypes.data, call[3:].ctypes.data, 0)


@njit(**LEAN)
def log1p(call, values, results):
    """See ``sin``."""
    _prepare(call, values, results)
    _log1p(call.ctypes.data, call[2:].ctypes.data, call[3:].ctypes.data, 0)


@njit(**LEAN)
def expm1(call, values, results):
    """See ``sin``."""
    _prepare(call, values, results)
    _expm1(call.ctypes.data, call[2:].ctypes.data, call[3:].ctypes.data, 0)


@njit(**LEAN)
def cbrt(call, values, results):
    """See ``sin``."""
    _prepare(call, values, results)
    _cbrt(call.ctypes.data, call[2:].ctypes.data, call[3:].ctypes.data, 0)
