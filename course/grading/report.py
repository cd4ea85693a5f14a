"""What grading one submission gives, before anybody writes it down."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from course.grading.checks.result import NOT_WRITTEN, Result, Status


class Scored(Protocol):
    """Something with points."""

    @property
    def points(self) -> float:
        """Earned."""
        ...

    @property
    def of(self) -> float:
        """That could be earned."""
        ...


class Total:
    """What has parts, and of points what they have together."""

    def parts(self) -> Sequence[Scored]:
        """What the points are of."""
        raise NotImplementedError

    @property
    def points(self) -> float:
        """Earned."""
        return sum(part.points for part in self.parts())

    @property
    def of(self) -> float:
        """That could be earned."""
        return sum(part.of for part in self.parts())


@dataclass(frozen=True)
class Report(Total):
    """All results of one submission.

    Attributes
    ----------
    student : whose it is; empty for one's own
    results : in the order of the course
    printed : module -> what its code printed
    protections : what kept the grader safe from the code
    seed, version : with which the result can be had again
    seconds : wall clock of it all
    trouble : why the submission could not be graded; empty if it was
    """

    student: str
    results: tuple[Result, ...]
    printed: Mapping[str, str] = field(default_factory=dict)
    protections: Sequence[str] = ()
    seed: int = 0
    version: str = ""
    seconds: float = 0.0
    trouble: str = ""

    def parts(self) -> tuple[Result, ...]:
        """Its results."""
        return self.results

    @property
    def score(self) -> float:
        """Share from 0 to 1; 0 where there is nothing to earn."""
        return self.points / self.of if self.of else 0.0

    def count(self, status: Status) -> int:
        """Checks that ended so."""
        return sum(result.status is status for result in self.results)


def findings(result: Result) -> list[tuple[str, str]]:
    """What a check that didn't pass has found, as labels with their text; what is empty is left out."""
    found = (
        ("expected", result.expected),
        ("found", result.found),
        ("where", result.where),
        ("the same as", result.same_as),
        ("hint", result.hint),
    )
    return [(label, text) for label, text in found if text]


def unstarted(result: Result) -> str:
    """Why a function is still to do: empty for a stub that nobody has touched, which needs no words."""
    return "" if result.found.endswith(NOT_WRITTEN) else result.found


def reproduce(result: Result, seed: int) -> str:
    """The one line that runs this check again."""
    return f"course check {result.module} --only {result.function}/{result.check} --seed {seed}"


def docs_page(result: Result) -> str:
    """The page of the docs that explains the function."""
    return f"docs/modules/{result.module}.md#{result.function}"
