"""Work on students' text that the grader does in a process of its own: a parser can be made to take long, or to die.

Nothing of the text is run. A process that takes more time or memory than it may is ended, and costs its own item only.
"""

from __future__ import annotations

import signal
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import cache
from typing import Generic, TypeVar

import psutil

from course.grading.classes.processes import in_processes

Item = TypeVar("Item")
Value = TypeVar("Value")

SECONDS = 5.0
"""Wall clock that one item may take."""

LARGEST_SPACE = 1_000_000_000
"""Bytes of address space that such a process may take besides what it has when it begins."""


@dataclass(frozen=True)
class _Limited(Generic[Item, Value]):
    """The function that is called for each item, within the limits."""

    function: Callable[[Item], Value]
    seconds: float

    def __call__(self, item: Item, _: None) -> Value:
        _limit_memory()
        if not hasattr(signal, "setitimer"):
            return self.function(item)
        # The parser doesn't come back to Python until it is done, so no exception could end it: the signal kills.
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_REAL, self.seconds)
        try:
            return self.function(item)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)


def apart(
    function: Callable[[Item], Value],
    items: Sequence[Item],
    jobs: int = 1,
    seconds: float = SECONDS,
) -> dict[int, Value | None]:
    """What a function gives for each item: by the item's place, None where it didn't come to an end.

    Parameters
    ----------
    function : one that can be imported
    jobs : processes
    seconds : that one item may take
    """
    values: dict[int, Value | None] = {}
    numbered = [*enumerate(items)]
    call = _Limited(_Numbered(function), seconds)
    if numbered:
        with closing(in_processes(call, numbered, None, jobs)) as outcomes:
            for outcome in outcomes:
                values[outcome.item[0]] = outcome.value
    return values


@dataclass(frozen=True)
class _Numbered(Generic[Item, Value]):
    function: Callable[[Item], Value]

    def __call__(self, item: tuple[int, Item]) -> Value:
        return self.function(item[1])


@cache
def _limit_memory() -> None:
    """Limit this process, once."""
    try:
        import resource

        hard = resource.getrlimit(resource.RLIMIT_AS)[1]
        # NumPy's threads take space by the number of cores.
        limit = psutil.Process().memory_info().vms + LARGEST_SPACE
        limit = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
        resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
    except (ImportError, OSError, ValueError, psutil.Error):
        return  # a system without such limits: time and the size of what is read are bounded still
