"""What one worker may use."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Limits:
    """What one worker may use.

    Attributes
    ----------
    call_seconds : wall clock of importing the file, and of one call at most; ``Patience`` says when it is less
    cpu_seconds : processor time of one worker process
    memory : bytes of address space
    deaths : processes that the calls of one function may end before it isn't called again
    """

    call_seconds: float = 10.0
    cpu_seconds: int = 60
    memory: int = 2 << 30
    deaths: int = 4
