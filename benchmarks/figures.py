"""One measured figure, and the table of all."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from course.benchmarking.tables import Table

DIGITS = 2
MOST_DIGITS = 9
"""After the point, in the table."""

COLUMNS = ("figure", "median", "range", "goal", "")


@dataclass(frozen=True)
class Figure:
    """A measurement and its goal.

    Attributes
    ----------
    name : what was measured
    value : the median
    low, high : the range over the repetitions
    goal : what it should reach; at most, or at least if ``at_least``
    """

    name: str
    value: float
    low: float
    high: float
    goal: float
    at_least: bool = False

    @property
    def reached(self) -> bool:
        """Whether the median meets the goal."""
        return self.value >= self.goal if self.at_least else self.value <= self.goal

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return {**asdict(self), "reached": self.reached}


def table(figures: Iterable[Figure]) -> Table:
    """A row for each figure, and whether it reaches its goal."""
    rows = tuple((*_cells(f), "reached" if f.reached else "missed") for f in figures)
    return Table("engine benchmark, ratios within this run", COLUMNS, rows)


def _cells(f: Figure) -> tuple[str, str, str, str]:
    sign = "≥" if f.at_least else "≤"
    digits = _digits(f)
    spread = f"{f.low:.{digits}f} .. {f.high:.{digits}f}"
    return f.name, f"{f.value:.{digits}f}", spread, f"{sign} {f.goal:g}"


def _digits(f: Figure) -> int:
    """Two after the point, or as many as it takes until a median that misses its goal doesn't look as if it didn't."""
    return next(
        (
            digits
            for digits in range(DIGITS, MOST_DIGITS)
            if f.reached or float(f"{f.value:.{digits}f}") != f.goal
        ),
        MOST_DIGITS,
    )


def summary(name: str, values: list[float], goal: float, *, at_least: bool = False) -> Figure:
    """The figure of repeated measurements."""
    ordered = sorted(values)
    return Figure(name, ordered[len(ordered) // 2], ordered[0], ordered[-1], goal, at_least)
