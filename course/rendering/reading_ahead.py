"""Numba, and the loops that are on disk, read by a thread while a scene is built; for the command line.

The interpreter's lock leaves room for that where meshes are large, for NumPy and Embree give it up.
"""

import sys
from collections.abc import Callable
from contextlib import suppress
from importlib.util import find_spec
from threading import Thread
from types import ModuleType

BLAS = "scipy.linalg.cython_blas"
"""Numba imports it, which takes longer than Numba itself, to see whether it is there."""


class ReadingAhead:
    """Reads in two steps, for what is between them must not meet an import of SciPy by another thread."""

    def __init__(self) -> None:
        self._thread: Thread | None = None

    @property
    def begun(self) -> bool:
        """Whether anything is read."""
        return self._thread is not None

    def begin(self) -> None:
        """Begin the first step."""
        self._start(_import_numba)

    def go_on(self) -> None:
        """Begin the second step, if the first was begun; the meshes have been read, and SciPy with them if at all."""
        self.close()
        # An older Numba refuses a newer NumPy.
        if self.begun and "numba" in sys.modules:
            _import_without_blas()
            self._start(_read_loops)

    def _start(self, work: Callable[[], None]) -> None:
        self._thread = Thread(target=work, daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Wait for what was begun."""
        if self._thread is not None:
            self._thread.join()


def _import_numba() -> None:
    with suppress(ImportError):
        import numba  # noqa: F401


def _import_without_blas() -> None:
    """Import the one part of Numba that asks for SciPy's BLAS. Who compiles a product of matrices imports it then."""
    if BLAS in sys.modules or find_spec("scipy") is None:
        return
    sys.modules[BLAS] = ModuleType(BLAS)
    try:
        import numba.np.arraymath  # noqa: F401
    finally:
        del sys.modules[BLAS]


def _read_loops() -> None:
    from numba.core.registry import cpu_target

    from course.rendering.background_compile import NotCompiledError, compiling_nothing

    cpu_target.target_context.refresh()
    with suppress(NotCompiledError), compiling_nothing():
        from course.compiled import fused  # noqa: F401
