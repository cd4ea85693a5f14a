"""Measured figures, and the table of all in docs/performance.md, part by part: what was not measured now stays.

docs/data/ratios.json holds every part's figures and the machine that they were measured on.
"""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from course.base.atomic import write_text
from course.benchmarking.documents import replace_marked
from course.benchmarking.plot_data import rounded
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


MARK = "make bench"
DATA = Path("data", "ratios.json")


def write_ratios(
    found: Mapping[str, Sequence[Figure]],
    machine: Mapping[str, str],
    folder: Path,
    order: Iterable[str],
) -> None:
    """Put the figures into the documentation.

    Parameters
    ----------
    found : part -> its figures
    machine : what they were measured with, name -> value
    folder : of performance.md and data/ratios.json
    order : of the parts in the table
    """
    path = folder / DATA
    parts: dict[str, Any] = json.loads(path.read_text("utf-8")) if path.is_file() else {}
    for name, figures in found.items():
        parts[name] = {"machine": dict(machine), "figures": [_plain(figure) for figure in figures]}
    parts = {name: parts[name] for name in order if name in parts}
    path.parent.mkdir(exist_ok=True)
    write_text(path, json.dumps(parts, indent=1, ensure_ascii=False) + "\n")
    replace_marked(folder / "performance.md", MARK, block(parts))


def block(parts: Mapping[str, Any]) -> str:
    """The table as Markdown, below it what was measured where."""
    figures = [Figure(**figure) for part in parts.values() for figure in part["figures"]]
    machines: dict[str, list[str]] = {}
    for name, part in parts.items():
        machines.setdefault(", ".join(part["machine"].values()), []).append(name)
    made = [
        f"Made by `python -m benchmarks {' '.join(names)} --write-docs` on {machine}."
        for machine, names in machines.items()
    ]
    return "\n\n".join([*made, table(figures).markdown()])


def _plain(figure: Figure) -> dict[str, Any]:
    data = {name: value for name, value in figure.to_dict().items() if name != "reached"}
    return {
        name: rounded(value) if isinstance(value, float) else value for name, value in data.items()
    }
