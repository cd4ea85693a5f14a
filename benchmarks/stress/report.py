"""The verdicts on the terminal."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console
from rich.table import Table

from benchmarks.stress.rows import Row, rows_of
from benchmarks.stress.verdict import Verdict

WIDTH = 110
MOST_FAILED = 20
"""Failed cells that are told one by one."""


def print_report(verdicts: Sequence[Verdict], *, cells: bool = False) -> None:
    """A table of the rows, after one of the cells if they are wanted; then the cells that failed."""
    console = Console(width=WIDTH)
    if cells:
        console.print(cells_table(verdicts))
    console.print(rows_table(rows_of(verdicts)))
    failed = [verdict for verdict in verdicts if not verdict.passed]
    for verdict in failed[:MOST_FAILED]:
        print_verdict(verdict, console)
    if len(failed) > MOST_FAILED:
        console.print(f"... and {len(failed) - MOST_FAILED} more")
    console.print(
        f"{len(verdicts) - len(failed)} of {len(verdicts)} cells passed; "
        f"{share_at_edges(verdicts):.1%} of the room's pixels are at edges"
    )


def share_at_edges(verdicts: Sequence[Verdict]) -> float:
    """Mean share of the pixels of the room that are at edges."""
    shares = [verdict.edges for verdict in verdicts if verdict.cell.startswith("room")]
    return sum(shares) / max(len(shares), 1)


def print_verdict(verdict: Verdict, console: Console | None = None) -> None:
    """One cell: what is broken, its levels, and how to judge it alone."""
    console = console or Console(width=WIDTH)
    if verdict.passed:
        console.print(f"[green]{verdict.cell} passed[/]: {_measured(verdict)}")
    for trouble in verdict.trouble:
        console.print(f"[red]{verdict.cell}[/]: {trouble}", highlight=False)
    levels = ", ".join(f"{axis}: {name}" for axis, name in verdict.levels.items())
    console.print(f"  {levels}", style="dim", highlight=False)
    if not verdict.passed:
        console.print(f"  python -m benchmarks.stress --cell {verdict.cell}", highlight=False)


def _measured(verdict: Verdict) -> str:
    return (
        f"deviation {verdict.error:.2g} of the brightest pixel, {verdict.share:.0%} of its bound; "
        f"energy {verdict.energy:.6f}; {verdict.jumps} pixels at edges differ, {verdict.jumps_allowed} may"
    )


def rows_table(rows: Sequence[Row]) -> Table:
    """Each axis and its levels."""
    table = Table(title="stress suite: the worst that was found on each level of each axis")
    for column in ("axis", "level"):
        table.add_column(column)
    for column in ("cells", "failed", "deviation", "of its bound", "energy", "at edges"):
        table.add_column(column, justify="right")
    axis = ""
    for row in rows:
        if row.axis != axis:
            table.add_section()
        color = "red" if row.failed else None
        cells = (row.axis if row.axis != axis else "", row.level, str(row.cells), str(row.failed))
        table.add_row(*cells, *_worst(row), style=color)
        axis = row.axis
    return table


def _worst(row: Row | Verdict) -> tuple[str, str, str, str]:
    return (f"{row.error:.1e}", f"{row.share:.0%}", f"{row.energy:.6f}", str(row.jumps))


def cells_table(verdicts: Sequence[Verdict]) -> Table:
    """Each cell, with those of its levels that every stage has."""
    table = Table(title="stress suite: the cells")
    axes = ("scale", "offset", "triangles", "angle", "resolution")
    for column in ("cell", *axes):
        table.add_column(column)
    for column in ("deviation", "of its bound", "energy", "at edges"):
        table.add_column(column, justify="right")
    for verdict in verdicts:
        color = None if verdict.passed else "red"
        levels = (verdict.levels[axis] for axis in axes)
        table.add_row(verdict.cell, *levels, *_worst(verdict), style=color)
    return table
