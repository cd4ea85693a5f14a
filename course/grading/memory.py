"""A bound on the memory of this process, for what it does with other people's files and values."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache

import psutil


@contextmanager
def at_most(more: int) -> Iterator[None]:
    """Within, this process has no more than ``more`` bytes beside what it had at first: else a MemoryError.

    What is allocated counts, whether it is used or not; a system that keeps no such account has no bound.
    """
    try:
        import resource

        old = resource.getrlimit(resource.RLIMIT_DATA)
        # Threads of NumPy's take space by the number of cores, so the bound is on what comes beside them.
        limit = _at_first() + more
        limit = limit if old[1] == resource.RLIM_INFINITY else min(limit, old[1])
        resource.setrlimit(resource.RLIMIT_DATA, (limit, old[1]))
    except (ImportError, AttributeError, OSError, ValueError, psutil.Error):
        yield
        return
    try:
        yield
    finally:
        with suppress(OSError, ValueError):
            resource.setrlimit(resource.RLIMIT_DATA, old)


@cache
def _at_first() -> int:
    return int(psutil.Process().memory_info().data)
