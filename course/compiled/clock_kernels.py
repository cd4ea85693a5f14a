"""The clock, for compiled loops."""

from __future__ import annotations

import sys

import numpy as np
from numba import njit, types

from course.compiled.options import OPTIONS

_WINDOWS = sys.platform == "win32"
_MONOTONIC = 6 if sys.platform == "darwin" else 1
_read = types.ExternalFunction(
    "QueryPerformanceCounter" if _WINDOWS else "clock_gettime",
    types.int32(types.uintp) if _WINDOWS else types.int32(types.int64, types.uintp),
)

if _WINDOWS:

    @njit(**OPTIONS)
    def nanoseconds():
        """Time by the performance counter, whose step is 100 ns [ns]."""
        ticks = np.empty(1, np.int64)
        _read(ticks.ctypes.data)
        return ticks[0] * 100

else:

    @njit(**OPTIONS)
    def nanoseconds():
        """Time since some moment [ns]."""
        time = np.empty(2, np.int64)
        _read(_MONOTONIC, time.ctypes.data)
        return time[0] * 1_000_000_000 + time[1]
