"""What of a failing cell makes it fail: as many levels as possible are made tame while it still fails."""

from __future__ import annotations

from benchmarks.stress.axes import TAME
from benchmarks.stress.cells import Cell, legal
from benchmarks.stress.running import judge_some


def shrunk(cell: Cell, compiled: bool | None = None) -> Cell:
    """A cell that fails too, and in which no level can be made tame without its passing."""
    left = list(cell.levels)
    while True:
        for axis in left:
            tamer = cell.with_level(axis, TAME[axis])
            if tamer.levels[axis] == cell.levels[axis] or not legal(tamer):
                continue
            if not judge_some([tamer], compiled)[0].passed:
                cell = tamer
                break
        else:
            return cell


def wild_levels(cell: Cell) -> dict[str, str]:
    """The levels that are not the tame ones."""
    return {axis: each.name for axis, each in cell.levels.items() if each.name != TAME[axis]}
