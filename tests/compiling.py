"""Loops are compiled by one process of a run at a time: the others read from disk what they would have compiled, too.

In a fresh copy each process of a run would compile the loops anew, which takes longer than most files of tests.
"""

import sqlite3
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from threading import local
from typing import Any

LONGEST = 800.0
"""Seconds in which a busy machine has compiled anything."""


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """Wait until no other process of a run compiles.

    A database is locked on every system alike, and no longer than its holder lives.
    """
    place = folder / "compiling.db"
    with closing(sqlite3.connect(place, LONGEST, isolation_level=None)) as turn:
        turn.execute("BEGIN EXCLUSIVE")
        yield


def take_turns(folder: Path) -> None:
    """Let Numba compile in this process when no other one does, and look for what that one has left."""
    from numba.core.caching import Cache
    from numba.core.dispatcher import Dispatcher

    load, compiled = Cache.load_overload, Dispatcher.compile
    mine = local()

    def look(cache: Any, signature: Any, context: Any) -> Any:
        found = load(cache, signature, context)
        if found is None and (turn := getattr(mine, "turn", None)) is not None:
            mine.turn = None
            turn.enter_context(alone(folder))
            found = load(cache, signature, context)
        return found

    def in_turn(dispatcher: Any, signature: Any) -> Any:
        if hasattr(mine, "turn"):
            return compiled(dispatcher, signature)
        # What a function calls is compiled within it.
        with ExitStack() as turn:
            mine.turn = turn
            turn.callback(delattr, mine, "turn")
            return compiled(dispatcher, signature)

    Cache.load_overload, Dispatcher.compile = look, in_turn
