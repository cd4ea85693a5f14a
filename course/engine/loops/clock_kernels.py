"""The clock, for compiled loops."""

import sys

from numba import types

from course.engine.loops.options import LEAN, njit

_WINDOWS = sys.platform == "win32"
_MONOTONIC = 6 if sys.platform == "darwin" else 1
_read = types.ExternalFunction(
    "QueryPerformanceCounter" if _WINDOWS else "clock_gettime",
    types.int32(types.uintp) if _WINDOWS else types.int32(types.int64, types.uintp),
)

if _WINDOWS:

    @njit(**LEAN)
    def nanoseconds(moment):
        """Time by the performance counter, whose step is 100 ns [ns]; ``moment`` (2,) int64 is overwritten."""
        _read(moment.ctypes.data)
        return moment[0] * 100

else:

    @njit(**LEAN)
    def nanoseconds(moment):
        """Time since some moment [ns]; ``moment`` (2,) int64 is overwritten."""
        _read(_MONOTONIC, moment.ctypes.data)
        return moment[0] * 1_000_000_000 + moment[1]
