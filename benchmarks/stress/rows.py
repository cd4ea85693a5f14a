"""The verdicts, put together: a row for each level of each axis, and the worst that was found in it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from benchmarks.stress.axes import AXES
from benchmarks.stress.verdict import Verdict


@dataclass(frozen=True)
class Row:
    """What was found in all cells with one level of one axis.

    Attributes
    ----------
    axis, level : names
    cells, failed : how many
    error : the largest deviation from the twin, edges left out, over the twin's brightest pixel
    share : the largest deviation over its bound
    energy : the brightest pixel over what its scene can bring at most
    jumps : the most pixels at edges of one cell that show something else
    """

    axis: str
    level: str
    cells: int
    failed: int
    error: float
    share: float
    energy: float
    jumps: int

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return asdict(self)


def rows_of(verdicts: Sequence[Verdict]) -> list[Row]:
    """A row for each level that occurs, and one for all."""
    rows = [
        _row(axis, level.name, [v for v in verdicts if v.levels.get(axis) == level.name])
        for axis, levels in AXES.items()
        for level in levels
    ]
    return [row for row in rows if row.cells] + [_row("all", "", verdicts)]


def _row(axis: str, level: str, verdicts: Sequence[Verdict]) -> Row:
    return Row(
        axis,
        level,
        len(verdicts),
        sum(not v.passed for v in verdicts),
        _largest(v.error for v in verdicts),
        _largest(v.share for v in verdicts),
        _largest(v.energy for v in verdicts),
        max((v.jumps for v in verdicts), default=0),
    )


def _largest(values: Iterable[float]) -> float:
    return max(values, default=0.0)
