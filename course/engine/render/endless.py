"""The end of threads in which a student's function never returns, after Ctrl-C."""

import ctypes
import sys
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from threading import Thread, get_ident
from time import monotonic
from types import FrameType

from course.base.errors import CourseWarning
from course.engine.functions.guard import asked_in, call_in

PATIENCE = 1.0
"""Seconds in which what is at work ends by itself: a tile asks after each batch of rays."""

AGAIN = 0.2
"""Seconds after which a thread is interrupted once more: a function may catch it."""

MOST = 10.0
"""Seconds until a thread is left to itself, as one that waits in a library written in C."""


LONG_CALL = 5.0
"""Seconds after which a function that is still in one call is told of; a slow right one answers within them."""


@dataclass
class LongCalls:
    """Tells of a student's function that doesn't come back: nobody can see which one a picture waits for.

    Each function is told of once.
    """

    _seen: dict[int, tuple[FrameType, float]] = field(default_factory=dict)
    _told: set[str] = field(default_factory=set)

    def look(self, threads: Sequence[Thread], now: float) -> None:
        """See where threads are.

        ``now``: [``time.monotonic()``]
        """
        frames, before = _frames(), self._seen
        self._seen = {}
        for number in [thread.ident or 0 for thread in threads]:
            call, _ = call_in(frames.get(number))
            if call is None:
                continue
            # A frame that is held is no other's later.
            known, since = before.get(number, (None, now))
            since = since if call is known else now
            self._seen[number] = call, since
            if now - since >= LONG_CALL and (said := asked_in(frames[number])):
                self._tell(said)

    def _tell(self, said: str) -> None:
        function = said.partition(" ")[0]
        if function not in self._told:
            self._told.add(function)
            warnings.warn(
                f"still in {said}, in one call for {LONG_CALL:g} s: Ctrl-C ends it, in a notebook the button that "
                "interrupts",
                CourseWarning,
                stacklevel=4,
            )


def end_endless(threads: Sequence[Thread]) -> None:
    """Wait for threads to end; those whose function goes on are interrupted in it, which is told by its name."""
    _await(threads, PATIENCE)
    frames = _frames()
    asked = [asked_in(frames.get(thread.ident or 0)) for thread in threads if thread.is_alive()]
    for said in dict.fromkeys(filter(None, asked)):
        warnings.warn(f"{said} was still at work, and was ended", CourseWarning, stacklevel=3)
    # Where a function has none of its own to interrupt, the batch of rays is long, and ends.
    began = monotonic()
    while any(asked) and _await(threads, 0) and monotonic() - began < MOST:
        for thread in threads:
            if thread.is_alive() and thread.ident is not None:
                ctypes.pythonapi.PyThreadState_SetAsyncExc(
                    ctypes.c_ulong(thread.ident), ctypes.py_object(KeyboardInterrupt)
                )
        _await(threads, AGAIN)


def _frames() -> dict[int, FrameType]:
    """Where the other threads are, by their numbers.

    Who holds its own frame, too, holds itself: all that the others' frames had would stay until garbage is collected.
    """
    frames = sys._current_frames()
    del frames[get_ident()]
    return frames


def _await(threads: Sequence[Thread], seconds: float) -> bool:
    """Whether one of them is still at work after so long."""
    end = monotonic() + seconds
    for thread in filter(Thread.is_alive, threads):
        thread.join(max(end - monotonic(), 0))
    return any(thread.is_alive() for thread in threads)
