"""What the loops that Numba compiles have in common; imported by files named ``..._kernels`` alone."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from numba import types

from course.engine.casters.older_loops import forget_older_loops
from course.engine.loops.embree_device import width

COLUMNS = types.float32[:, ::1]
"""(k, N) float32, C-contiguous."""

ROW = types.float32[::1]
"""(N,) float32, contiguous."""

OBJECTS = types.int8[::1]
"""(N,) int8, contiguous: numbers of convex objects."""

# LLVM unrolls the short loops over a packet's lanes before it looks for vectors in loops: this finds them afterwards.
# Sums keep their order, so the bits are the same.
numba.config.SLP_VECTORIZE = 1

OPTIONS = {"nogil": True, "cache": True, "error_model": "numpy"}
"""Without the interpreter lock, kept on disk, and with divisions by zero as NumPy has them."""


def njit(*signature: Any, **options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Numba's ``njit``; on disk a loop has the packets' width in its name, for it is another loop in every width."""

    def compiled(function: Callable[..., Any]) -> Any:
        function.__qualname__ += f"_{width()}"
        return numba.njit(*signature, **options)(function)

    return compiled


_INNER = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""Neither Python nor C calls such parts. An entrance would take apart every array: a sixth of the time to compile."""

APART = OPTIONS | _INNER | {"_nrt": False}
"""For parts of the fused loop: arrays aren't counted whenever one is handed on, which would take more time than the
arithmetic. So none can be made there. These parts are called: they are long, or called at many places."""

LEAN = APART | {"forceinline": True}
"""The same for parts that become a piece of what calls them."""


forget_older_loops(Path(__file__).parent)
