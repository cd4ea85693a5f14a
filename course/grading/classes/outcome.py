"""What an engine hands back for each item of work."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

Item = TypeVar("Item")
Shared = TypeVar("Shared")
Value = TypeVar("Value")


@dataclass(frozen=True)
class Outcome(Generic[Item, Value]):
    """How the work on one item ended.

    Attributes
    ----------
    item : the work
    value : what came of it; None after a fault
    fault : what went wrong in the grader itself; empty if nothing did
    """

    item: Item
    value: Value | None
    fault: str = ""


Engine = Callable[
    [Callable[[Item, Shared], Value], Sequence[Item], Shared],
    Generator[Outcome[Item, Value], None, None],
]
"""(function, items, what all items share) -> an outcome for each item, in whatever order they end.

The function takes an item and what is shared. Closing the iterator ends all work.
"""


def told(error: BaseException) -> str:
    """An exception in a line."""
    return f"{type(error).__name__}: {error}".removesuffix(": ")
