"""NumPy's own loops of sines, logarithms and the like for compiled code, so that both have the same last bits.

Every library rounds these functions in its own way, and NumPy's way depends on the processor. So compiled loops call
the very function that ``np.sin`` calls for float32 arrays, which needs no interpreter lock.
"""

import llvmlite.binding
import numpy as np
from numba import types
from numpy.typing import NDArray

from course.engine.loops.numpy_loops import OF_TWO, loops
from course.engine.loops.options import LEAN, njit

_LOOPS = loops()
assert _LOOPS is not None, "asked before the loops are read: see embree_device.available"
for _name, (_address, _) in _LOOPS.items():
    llvmlite.binding.add_symbol(f"course_numpy_{_name}", _address)

_loop_type = types.void(*[types.uintp] * 4)
_sin = types.ExternalFunction("course_numpy_sin", _loop_type)
_cos = types.ExternalFunction("course_numpy_cos", _loop_type)
_log = types.ExternalFunction("course_numpy_log", _loop_type)
_exp = types.ExternalFunction("course_numpy_exp", _loop_type)
_log1p = types.ExternalFunction("course_numpy_log1p", _loop_type)
_expm1 = types.ExternalFunction("course_numpy_expm1", _loop_type)
_cbrt = types.ExternalFunction("course_numpy_cbrt", _loop_type)
_arctan2 = types.ExternalFunction("course_numpy_arctan2", _loop_type)
_hypot = types.ExternalFunction("course_numpy_hypot", _loop_type)

_OF_TWO = tuple(_LOOPS[name][1] for name in OF_TWO)
_TWO, _OF_ARCTAN2, _OF_HYPOT = 5, 12, 13
"""Where, in what a call hands over, that of functions of two arguments begins, and what their loops are handed."""


def call_of() -> NDArray[np.int64]:
    """What a call hands over: addresses of arguments and result, their number, and the steps between them in bytes."""
    return np.array((*(0, 0, 0, 4, 4), *(0, 0, 0, 0, 4, 4, 4), *_OF_TWO), np.int64)


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


@njit(**LEAN)
def _prepare_two(call, first, second, results):
    call[_TWO], call[_TWO + 1] = first.ctypes.data, second.ctypes.data
    call[_TWO + 2], call[_TWO + 3] = results.ctypes.data, len(results)


@njit(**LEAN)
def arctan2(call, first, second, results):
    """``np.arctan2`` of contiguous float32 values, into results; so is the other."""
    _prepare_two(call, first, second, results)
    arguments, number, steps = call[_TWO:], call[_TWO + 3 :], call[_TWO + 4 :]
    _arctan2(arguments.ctypes.data, number.ctypes.data, steps.ctypes.data, call[_OF_ARCTAN2])


@njit(**LEAN)
def hypot(call, first, second, results):
    """See ``arctan2``."""
    _prepare_two(call, first, second, results)
    arguments, number, steps = call[_TWO:], call[_TWO + 3 :], call[_TWO + 4 :]
    _hypot(arguments.ctypes.data, number.ctypes.data, steps.ctypes.data, call[_OF_HYPOT])
