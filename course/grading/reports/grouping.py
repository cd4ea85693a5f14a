"""The results of a report by module and function.

The checks of one function need not run one after the other: those that judge pictures come last in a module.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from course.grading.checks.result import Result, Status
from course.grading.report import Report, Total

_LAST = ("untouched", "refuses", "layouts", "columns")
"""Checks whose failures say the least where others have failed as well."""

_DRAWN = ("picture", "bias", "order", "speed")
"""Kinds that say that something is wrong, and not what."""

State = Literal["right", "wrong", "to do", "undecided"]


@dataclass(frozen=True)
class FunctionResults(Total):
    """All results of one function.

    Attributes
    ----------
    module, name : which one
    results : in the order of the checks
    """

    module: str
    name: str
    results: tuple[Result, ...]

    @property
    def state(self) -> State:
        """What the function is; undecided where nothing but the grader itself has failed."""
        statuses = {result.status for result in self.results}
        if statuses <= {Status.PASSED}:
            return "right"
        if statuses == {Status.NOT_ATTEMPTED}:
            return "to do"
        return "undecided" if statuses <= {Status.PASSED, Status.GRADER_ERROR} else "wrong"

    @property
    def passed(self) -> tuple[Result, ...]:
        """Results of the checks that passed."""
        return tuple(result for result in self.results if result.status is Status.PASSED)

    @property
    def others(self) -> tuple[Result, ...]:
        """Results of the checks that didn't."""
        return tuple(result for result in self.results if result.status is not Status.PASSED)

    @property
    def told(self) -> tuple[Result, ...]:
        """Those of the others that have something of their own to say, the most telling ones first."""
        told = [result for result in self.others if not result.same_as]
        # A stub comes with its refusals: what is wrong with the mathematics is what a student wants to know.
        return tuple(
            sorted(
                told,
                key=lambda r: (r.check in _LAST, r.kind in _DRAWN, r.check != "contract", -r.of),
            )
        )

    @property
    def repeated(self) -> tuple[tuple[str, tuple[Result, ...]], ...]:
        """Those that say what an earlier one has said, by what they have found."""
        found: dict[str, list[Result]] = {}
        for result in self.others:
            if result.same_as:
                found.setdefault(result.found, []).append(result)
        return tuple((text, tuple(results)) for text, results in found.items())

    def parts(self) -> tuple[Result, ...]:
        """Its results."""
        return self.results


@dataclass(frozen=True)
class ModuleResults(Total):
    """All functions of one module.

    Attributes
    ----------
    name : the module's
    functions : in the order in which they were first checked
    """

    name: str
    functions: tuple[FunctionResults, ...]

    @property
    def trouble(self) -> Result | None:
        """Why no function of it could be called; None if they could."""
        first = self.functions[0].results[0]
        return first if first.module_wide else None

    def parts(self) -> tuple[FunctionResults, ...]:
        """Its functions."""
        return self.functions

    def count(self, state: State) -> int:
        """Functions that are so."""
        return sum(function.state == state for function in self.functions)


def grouped(report: Report) -> tuple[ModuleResults, ...]:
    """Modules and functions in the order in which they first appear."""
    modules: dict[str, dict[str, list[Result]]] = {}
    for result in report.results:
        modules.setdefault(result.module, {}).setdefault(result.function, []).append(result)
    return tuple(
        ModuleResults(
            module,
            tuple(
                FunctionResults(module, function, tuple(results))
                for function, results in functions.items()
            ),
        )
        for module, functions in modules.items()
    )
