"""The closer look that follows a failed check: which known mistake it may be, and the rays behind a wrong picture.

It earns nobody a point, so it has bounds: what a function gives for it, and how long that takes, altogether. A function
that is over them keeps its points, and is told that there was no closer look.
"""

from collections.abc import Callable
from dataclasses import replace

from course.school.grading.checks.bounds import Bounded
from course.school.grading.checks.check import Caller, Check, ModuleChecks, References
from course.school.grading.checks.mistakes import explains, known_mistake
from course.school.grading.checks.picture_rays import PICTURE, rays_behind
from course.school.grading.checks.result import Result

NO_CLOSER_LOOK = "There was no closer look at what is wrong: {}."

BEGIN = "Begin with {}: this function calls it, and it is wrong."


class CloserLook:
    """What is said beside the failures of one module.

    Parameters
    ----------
    checks : of the module
    references : arrays to compare with
    seed : of the checks
    gate : puts a caller behind the gate of the module
    """

    def __init__(
        self,
        checks: ModuleChecks,
        references: References,
        seed: int,
        gate: Callable[[Caller], Caller],
    ) -> None:
        self._checks, self._references, self._seed, self._gate = checks, references, seed, gate
        self._matched: dict[str, tuple[str, str] | None] = {}
        self._wrong: dict[str, None] = {}

    def at(self, result: Result, check: Check, caller: Caller, alone: bool) -> Result:
        """A failed check's result, with all that can be said of it.

        ``alone``: whether nobody lends right functions in place of those above
        """
        above = _above(check.function, self._wrong, caller) if alone else ""
        self._wrong.setdefault(check.function)
        own = Bounded(caller)
        if above:
            hint = f"{BEGIN.format(above)} {result.hint}".strip()
            result = replace(result, hint=hint, mistake="", says="")
        else:
            result = self._named(result, check, own)
        if check.name == PICTURE and not own.over:
            behind = self._gate(own)
            shown = rays_behind(self._checks, check, behind, self._references, self._seed)
            result = replace(result, figures=(*result.figures, *shown))
        if own.over:
            hint = f"{result.hint} {NO_CLOSER_LOOK.format(own.over)}".strip()
            result = replace(result, hint=hint)
        return result

    def _named(self, result: Result, check: Check, caller: Caller) -> Result:
        """The result with the known mistake that the function makes, where that explains it."""
        function = check.function
        if function not in self._matched:
            self._matched[function] = known_mistake(
                self._checks, function, caller, self._references
            )
        mistake = self._matched[function]
        if mistake is None or not explains(self._checks.module, check, mistake[0]):
            return result
        return replace(result, mistake=mistake[0], says=mistake[1])


def _above(function: str, wrong: dict[str, None], caller: Caller) -> str:
    """The first of the functions found wrong that this one calls; empty if there is none."""
    calls = getattr(caller, "calls", None)
    return next((o for o in wrong if calls and o != function and calls(function, o)), "")
