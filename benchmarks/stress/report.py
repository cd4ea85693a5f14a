"""What the verdicts on all cells show: rows on the screen, and the page in the documentation."""

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from benchmarks.stress.axes import AXES
from benchmarks.stress.verdict import FALSE_FAIL, GAIN, ROUNDING, Verdict


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


PAGE = Path(__file__).resolve().parents[2] / "docs" / "accuracy.md"
BEGIN = "<!-- stress suite: begin -->"
END = "<!-- stress suite: end -->"

TEXT = """\
## Numerical stability

A scene in nanometres or in parsecs, far from the origin, made of slivers, seen and lit at a millionth of a radian, is
the same picture as its well-conditioned twin: at the origin, of unit size, cut into two triangles where the other is
cut into thousands. `make stress` renders {cells:,} such cells, in which every two levels of any two axes meet
(unless no file can hold the two together), and says of each:

- **Finite.** Every pixel is finite and not negative, and NumPy has nothing to warn of.
- **No energy is created.** No pixel is brighter than a bound that follows from the scene. In a furnace, the same shapes
  in a uniform radiance of 1, no pixel shows more than 1.
- **Equal to its twin.** The pictures have the same random numbers. Whatever a ray meets lies by a stated shift apart
  at most: the rounding of float32, and what each level adds. So every pixel differs by at most

      {gain:g} * shift * (1 + bounces) * steepness + {rounding:g} * 2^-24 * (brightest pixel)

  and, where an object is the light, by the error of its area besides.
  How steeply a pixel answers to a change of the scene is measured on the twin. Where a small change lets a sample meet
  another thing, it may also do so in the cell: at such edges as many pixels may differ as the shift explains (the
  quantile of a Poisson distribution at {false_fail:g}), and none may show what is not seen around it. A flat patch and
  a closed box of mirrors have a radiance in closed form, and there the bound is rounding alone; not one ray, in up to
  65 bounces, gets out of the box.
- **Physics.** Plates of glass, clear, coloured and frosted, and sheets of metal are held against Fresnel's formulae in
  another form, in float64, and against the sum over all ways through a plate: this would show a reflectance that cell
  and twin have wrong alike.

The worst that was found on each level of each axis: the deviation from the twin as a share of its brightest pixel, the
same as a share of its bound, the brightest pixel as a share of what the scene can bring, and the most pixels at the
edges of one picture that show something else ({edges:.0%} of all pixels are at edges). {outcome}
"""


def write_page(verdicts: Sequence[Verdict], page: Path = PAGE) -> None:
    """Put the section into the page, in place of the one that is there."""
    section = f"{BEGIN}\n{section_of(verdicts)}{END}\n"
    text = page.read_text(encoding="utf-8") if page.is_file() else "# Accuracy\n\n"
    if BEGIN in text and END in text:
        before, rest = text.split(BEGIN, 1)
        text = before + section + rest.split(END, 1)[1].removeprefix("\n")
    else:
        text = text.rstrip("\n") + "\n\n" + section
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text(text, encoding="utf-8")


def section_of(verdicts: Sequence[Verdict]) -> str:
    """The section in Markdown."""
    rows = rows_of(verdicts)
    failed = rows[-1].failed
    outcome = "Every cell passed." if failed == 0 else f"{failed} cells failed."
    text = TEXT.format(
        cells=len(verdicts),
        gain=GAIN,
        rounding=ROUNDING,
        false_fail=FALSE_FAIL,
        outcome=outcome,
        edges=share_at_edges(verdicts),
    )
    lines = ["| axis | level | cells | failed | deviation | of its bound | energy | at edges |"]
    lines += ["| --- | --- | --: | --: | --: | --: | --: | --: |"]
    lines += [_line(row, previous) for row, previous in zip(rows, [None, *rows], strict=False)]
    return text + "\n" + "\n".join(lines) + "\n\n"


def _line(row: Row, previous: Row | None) -> str:
    axis = "" if previous is not None and previous.axis == row.axis else row.axis
    numbers = f"{row.cells} | {row.failed} | {row.error:.1e} | {row.share:.0%} | {row.energy:.4f}"
    return f"| {axis} | {row.level} | {numbers} | {row.jumps} |"
