"""Numba, and the loops that are on disk, read by a thread while a scene is built; for the command line.

The interpreter's lock leaves room for that where meshes are large, for NumPy and Embree give it up.
"""

from contextlib import suppress
from threading import Thread


class ReadingAhead:
    """Reads once it has begun."""

    def __init__(self) -> None:
        self._thread: Thread | None = None

    @property
    def begun(self) -> bool:
        """Whether anything is read."""
        return self._thread is not None

    def begin(self) -> None:
        """Begin to read."""
        self._thread = Thread(target=_read_loops, daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Wait for what was begun."""
        # Ctrl-C may have come before it was started.
        if self._thread is not None and self._thread.is_alive():
            self._thread.join()


def _read_loops() -> None:
    from course.engine.render.background_compile import NotCompiledError, compiling_nothing

    # An older Numba refuses a newer NumPy.
    with suppress(ImportError, NotCompiledError), compiling_nothing():
        from course.engine.loops import fused  # noqa: F401
