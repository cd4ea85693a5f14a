"""How long the functions of one module are waited for, together: a module that hangs must not keep anybody waiting.

Only the time of calls that never end is counted. A submission that is slow and right uses none of it, however long its
checks take, so a machine that is busy costs nobody anything.
"""

from __future__ import annotations

from course.grading.errors import StudentError

ALTOGETHER = 1.5
"""What the calls of one module that never end may take together, in calls' longest times."""

NEW, KNOWN = 0.25, 0.75
"""Shares of what is left that one call may take: of a function that hasn't answered yet, and of one that has. The
first calls are small ones, and what never ends mostly never ends at the first; so most hangs are found for little,
and what is left is for functions that have shown that they do end."""

LEAST = 0.05
"""Of a call's longest time: every call is given as much, and where less is left none is made, for right functions
might run out of it too."""

NOT_RUN = "not run for want of time"


class Patience:
    """What is left of the time for calls that never end; one for all workers of a module.

    Parameters
    ----------
    call_seconds : the longest time of one call
    small_first : whether the first calls of a function are small ones, as they are where all checks are run
    """

    def __init__(self, call_seconds: float, small_first: bool = True) -> None:
        self._longest = call_seconds
        self._new = NEW if small_first else KNOWN
        self._lost = 0.0

    def limit(self, answered: bool) -> float:
        """How long the next call may take [s].

        Parameters
        ----------
        answered : whether the function has given a value before

        Raises
        ------
        StudentError
            "timeout": no time is left.
        """
        left, least = ALTOGETHER * self._longest - self._lost, LEAST * self._longest
        if left < least:
            raise StudentError(
                "timeout",
                f"{NOT_RUN}: calls of this module that don't end have taken {self._lost:.1f} s",
            )
        share = left * (KNOWN if answered else self._new)
        return min(self._longest, max(share, least))

    def lose(self, seconds: float) -> None:
        """A call has taken so long and not ended."""
        self._lost += seconds

    def __str__(self) -> str:
        """Why a limit is shorter than usual; empty if it isn't."""
        return (
            f" (less than usual: calls before have taken {self._lost:.1f} s and not ended)"
            if self._lost
            else ""
        )
