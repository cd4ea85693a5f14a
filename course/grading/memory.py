"""A bound on the memory of this process, for what it does with other people's files and values."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress

import psutil


@contextmanager
def at_most(more: int) -> Iterator[None]:
    """Within, this process has no more than ``more`` bytes of data beside what it has now: else a MemoryError.

    What is allocated counts, whether it is used or not; a system that keeps no such account has no bound.
    """
    try:
        import resource

        old = resource.getrlimit(resource.RLIMIT_DATA)
        # Threads of NumPy's take space by the number of cores, so the bound is on what comes beside them.
        limit = psutil.Process().memory_info().data + more
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
