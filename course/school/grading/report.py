"""The report of one submission, before anybody writes it down; its results by module and function, too.

The checks of one function need not run one after the other: those that judge pictures come last in a module.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import fsum
from typing import Literal

from course.engine.functions.modules import COURSE
from course.school.grading.checks.result import NOT_WRITTEN, Result, Status

USUAL_SEED = 0
"""Of checks whose references a student's copy has."""

UNPROTECTED = "NOT PROTECTED"
"""How the protection begins that says what a submission's code could have done, where some are missing."""

_LAST = ("refuses", "layouts", "columns")
"""Checks whose failures say the least where others have failed as well."""

_FIRST = ("contract", "untouched", "unit_length")
"""Checks that say why others failed: wrong shapes above all, then arguments that were written to, then lengths, on
which distributions depend."""

_DRAWN = ("picture", "bias", "order", "speed")
"""Kinds that say that something is wrong, and not what."""

State = Literal["right", "wrong", "to do", "undecided"]


def _first(result: Result) -> int:
    """Its place in ``_FIRST``; a wrong dtype doesn't say why others failed."""
    first = result.check in _FIRST and " of dtype " not in result.expected
    return _FIRST.index(result.check) if first else len(_FIRST)


class Total:
    """A sum: its points are those of its parts."""

    def parts(self) -> "Sequence[Result | Total]":
        """The parts whose points are summed."""
        raise NotImplementedError

    @property
    def points(self) -> float:
        """Earned."""
        return fsum(part.points for part in self.parts())

    @property
    def of(self) -> float:
        """That could be earned."""
        return fsum(part.of for part in self.parts())


@dataclass(frozen=True)
class Report(Total):
    """All results of one submission.

    Attributes
    ----------
    student : whose it is; empty for one's own
    results : in the order of the course
    printed : module -> what its code printed
    protections : what kept the grader safe from the code
    seed : with which the result can be had again; None where whoever reads it is not to know it
    version : likewise
    seconds : wall clock of it all
    trouble : why the submission could not be graded; empty if it was
    remarks : what was guessed of the files that were handed in, and what of them was left out
    """

    student: str
    results: tuple[Result, ...]
    printed: Mapping[str, str] = field(default_factory=dict)
    protections: Sequence[str] = ()
    seed: int | None = 0
    version: str = ""
    seconds: float = 0.0
    trouble: str = ""
    remarks: Sequence[str] = ()

    def parts(self) -> tuple[Result, ...]:
        """Its results."""
        return self.results

    @property
    def score(self) -> float:
        """Share from 0 to 1; 0 where there is nothing to earn."""
        return self.points / self.of if self.of else 0.0

    @property
    def unprotected(self) -> str:
        """The harm that the code could have done to the grader, and so to this report; empty if none."""
        return next((one for one in self.protections if one.startswith(UNPROTECTED)), "")

    @property
    def broken(self) -> tuple[Result, ...]:
        """Results of the checks that broke, whatever points they gave: somebody has to look at these."""
        return tuple(
            result
            for result in self.results
            if result.broken or result.status is Status.GRADER_ERROR
        )

    def count(self, status: Status) -> int:
        """Checks that ended so."""
        return sum(result.status is status for result in self.results)


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
        """The state of the function; undecided where nothing but the grader itself has failed."""
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
        """The others that have something of their own to say, the most telling ones first."""
        told = [result for result in self.others if not result.same_as]
        # A stub comes with its refusals: what is wrong with the mathematics is what a student wants to know.
        return tuple(
            sorted(
                told,
                key=lambda r: (
                    r.check in _LAST,
                    r.kind in _DRAWN,
                    _first(r),
                    -r.of,
                ),
            )
        )

    @property
    def repeated(self) -> tuple[tuple[str, tuple[Result, ...]], ...]:
        """The others that say what an earlier one has said, by what they have found first.

        Sizes don't count: the same cause with another number of columns is the same.
        """
        found: dict[str, list[Result]] = {}
        for result in self.others:
            if result.same_as:
                found.setdefault(re.sub(r"\d+", "#", result.found), []).append(result)
        return tuple((results[0].found, tuple(results)) for results in found.values())

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


RUNGS = 3
"""Of the ladder: what is broken, the smallest input that breaks it, and which mistake that looks like."""


def findings(result: Result, rungs: int = RUNGS) -> list[tuple[str, str]]:
    """The findings of a check that didn't pass, as labels with their text; what is empty is left out.

    ``rungs``: of the ladder, how many to go down: the first says which law is broken, the second shows the smallest
    input that breaks it, the third says which known mistake it looks like
    """
    smallest = "" if result.example in result.where else result.example
    ladder = (
        (
            ("expected", result.expected),
            ("found", result.found),
            # Where there is a smaller input that shows it, the worst one of thousands says no more; an exception's
            # lines do.
            ("where", "" if smallest and "\n" not in result.where else result.where),
            ("the same as", result.same_as),
            ("hint", result.hint),
        ),
        (("smallest", smallest),),
        (("looks like", result.says),),
    )
    return [(label, text) for rung in ladder[:rungs] for label, text in rung if text]


def as_points(number: float) -> str:
    """Points as people read them: two decimals at most."""
    return f"{round(number, 2):g}"


def ending(result: Result) -> str:
    """How a check ended, and whether it broke."""
    return f"{result.status}, the check broke" if result.broken else str(result.status)


def broke(report: Report) -> str:
    """That checks broke, in a sentence with a blank before it; empty where none did."""
    number = len(report.broken)
    if not number:
        return ""
    many = "1 check" if number == 1 else f"{number} checks"
    return f" {many} broke: whoever graded this has been told."


def unstarted(result: Result) -> str:
    """Why a function is still to do: empty for a stub that nobody has touched, which needs no words."""
    return "" if result.found.endswith(NOT_WRITTEN) else result.found


def reproduce(result: Result, seed: int | None) -> str:
    """The one line that runs this check again; where the seed is hidden, with that of one's own copy."""
    # The check of all modules together is made when all of them are checked.
    module = f" {result.module}" if result.module in COURSE else ""
    told = "" if seed is None else f" --seed {seed}"
    return f"course check{module} --only {result.function}/{result.check}{told}"


def docs_page(result: Result) -> str:
    """The page of the docs that explains the function."""
    if result.module not in COURSE:
        return "docs/grading.md#for-students"
    return f"docs/modules/{result.module}.md#{result.function}"


def for_students(report: Report) -> Report:
    """The report as its student may have it: a seed that isn't everybody's is what keeps the tests hidden."""
    return report if report.seed == USUAL_SEED else replace(report, seed=None)
