"""What a worker, and all workers of a submission together, may use."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Limits:
    """What a worker, and all workers of a submission together, may use.

    Attributes
    ----------
    call_seconds : wall clock of importing the file, and of one call at most; ``Patience`` says when it is less
    cpu_seconds : processor time of one worker process
    memory : bytes: the address space of each process, and what all workers of a submission may hold together
    deaths : processes that the calls of one function may end before it isn't called again
    submission_seconds : wall clock of all checks of a submission, after which no function is called; None for no limit
    """

    call_seconds: float = 10.0
    cpu_seconds: int = 60
    memory: int = 2 << 30
    deaths: int = 4
    submission_seconds: float | None = None
