"""Cells judged in processes, and failed cells made as tame as they may be while they fail."""

import multiprocessing
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from itertools import groupby
from pathlib import Path

from benchmarks.stress.axes import TAME
from benchmarks.stress.cells import Cell, legal
from benchmarks.stress.verdict import Judge, Verdict
from course.engine.render.threads import default_threads

AT_ONCE = 16
"""Cells that a process takes at a time, or all of a family."""


def judge_all(
    cells: Sequence[Cell],
    jobs: int | None = None,
    tick: Callable[[int], None] | None = None,
    compiled: bool | None = None,
) -> list[Verdict]:
    """The verdict on each cell, in order.

    Parameters
    ----------
    jobs : processes; None for one a core, 1 for this one
    tick : called now and then with the number of cells judged since
    compiled : see `Judge`
    """
    tasks = list(_tasks(cells))
    jobs = jobs or default_threads()
    judge = partial(judge_some, compiled=compiled)
    if jobs == 1:
        return _collected(map(judge, tasks), tick)
    # Spawned, not forked: the same on all systems, and nothing is inherited.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=context) as pool:
        return _collected(pool.map(judge, tasks), tick)


def judge_some(cells: Sequence[Cell], compiled: bool | None = None) -> list[Verdict]:
    """The verdicts on some cells, in this process."""
    with tempfile.TemporaryDirectory(prefix="stress-") as folder:
        judge = Judge(Path(folder), compiled)
        return [judge(cell) for cell in cells]


def _collected(
    results: Iterable[list[Verdict]], tick: Callable[[int], None] | None
) -> list[Verdict]:
    verdicts: list[Verdict] = []
    for some in results:
        verdicts += some
        if tick is not None:
            tick(len(some))
    return verdicts


def _tasks(cells: Sequence[Cell]) -> Iterator[list[Cell]]:
    for stage, there in groupby(cells, key=lambda cell: cell.stage):
        if stage == "room":
            yield from (list(family) for _, family in groupby(there, key=lambda cell: cell.family))
        else:
            rest = list(there)
            yield from (rest[k : k + AT_ONCE] for k in range(0, len(rest), AT_ONCE))


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
