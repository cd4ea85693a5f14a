"""Keep freed memory for the next batch instead of handing it back to the system.

The arrays of a batch are a few hundred kilobytes each. The C library of Linux takes such blocks from the system and
returns them at once, and the next batch pays for every page again, until it has seen a larger block freed: then it
keeps blocks up to that size (mallopt(3), dynamic mmap threshold). Whether a scene's loading happens to free one is a
lottery: the same render took 0.44 or 0.63 s, with 4 or 85,000 page faults. Freeing one block of nearly the largest
size that counts settles it; the block is never touched, so it costs nothing. Other systems don't mind.
"""

import numpy as np

LARGEST = 31 << 20
"""Bytes; glibc's limit is 32 MB."""


def keep_freed_memory() -> None:
    """Let the C library keep what the batches free."""
    np.empty(LARGEST, np.uint8)
