"""What the loops that Numba compiles have in common; imported by files named ``..._kernels`` alone."""

from contextlib import suppress
from pathlib import Path

from numba import types

COLUMNS = types.float32[:, ::1]
"""(k, N) float32, C-contiguous."""

ROW = types.float32[::1]
"""(N,) float32, contiguous."""

OBJECTS = types.int8[::1]
"""(N,) int8, contiguous: numbers of convex objects."""

OPTIONS = {"nogil": True, "cache": True, "error_model": "numpy"}
"""Without the interpreter lock, kept on disk, and with divisions by zero as NumPy has them."""

_INNER = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""Neither Python nor C calls such parts. An entrance would take apart every array: a sixth of the time to compile."""

LEAN = OPTIONS | _INNER | {"_nrt": False, "forceinline": True}
"""For parts of the fused loop: arrays aren't counted whenever one is handed on, which would take more time than the
arithmetic. So none can be made there."""


def _forget_older_loops() -> None:
    """Compile anew what is older than any source: Numba looks at a loop's own file, not at those that it calls."""
    here = Path(__file__).parent
    newest = max(file.stat().st_mtime for file in here.glob("*.py"))
    for index in (here / "__pycache__").glob("*.nbi"):
        # Another process may have deleted it, too.
        with suppress(FileNotFoundError):
            if index.stat().st_mtime < newest:
                index.unlink()


_forget_older_loops()
