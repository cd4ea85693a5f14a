"""Tables of what was measured: for the terminal, and as Markdown for the documentation."""

import math
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import click
import numpy as np

from course.benchmarking.curves import Converged, ConvergenceOrder, Curve
from course.benchmarking.measuring import Measured

COMMON = 64
"""Samples at which estimators are compared by one number."""

NONE = "-"

BAR = r"\|"
"""A bar in a cell of a Markdown table."""


@dataclass(frozen=True)
class Table:
    """A title, the columns' headings, and rows of as many cells; the first column is left aligned."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def markdown(self) -> str:
        """The table as GitHub's Markdown, without its title; bars in cells are escaped, lest they end them."""
        rule = ("---", *("---:" for _ in self.columns[1:]))
        return "\n".join(
            f"| {' | '.join(cell.replace('|', BAR) for cell in row)} |"
            for row in (self.columns, rule, *self.rows)
        )

    def plain(self) -> str:
        """The table as text in columns."""
        widths = [max(map(len, column)) for column in zip(self.columns, *self.rows, strict=True)]
        lines = [
            "  ".join(
                cell.ljust(width) if number == 0 else cell.rjust(width)
                for number, (cell, width) in enumerate(zip(row, widths, strict=True))
            )
            for row in (self.columns, *self.rows)
        ]
        return "\n".join([self.title, *(f"  {line}".rstrip() for line in lines)])


Item = TypeVar("Item")
Columns = Sequence[tuple[str, Callable[[Item], str]]]
"""Each column's heading, and what makes its cell of an item."""


def table_of(title: str, items: Iterable[Item], columns: Columns[Item]) -> Table:
    """Make a table with a row for each item."""
    rows = tuple(tuple(cell(item) for _, cell in columns) for item in items)
    return Table(title, tuple(heading for heading, _ in columns), rows)


def print_tables(tables: Iterable[Table]) -> None:
    """Print on stdout: rich's tables on a terminal, aligned text elsewhere."""
    if sys.stdout.isatty():
        _print_rich(tables)
    else:
        click.echo("\n\n".join(table.plain() for table in tables))


def _print_rich(tables: Iterable[Table]) -> None:
    from rich.box import HORIZONTALS
    from rich.console import Console
    from rich.table import Table as RichTable
    from rich.text import Text

    console = Console()
    for table in tables:
        shown = RichTable(box=HORIZONTALS, title_justify="left", border_style="dim")
        shown.title = Text(table.title, style="bold")
        for number, column in enumerate(table.columns):
            shown.add_column(
                Text(column),
                justify="left" if number == 0 else "right",
                style="cyan" if number == 0 else "",
                no_wrap=number == 0,
            )
        for row in table.rows:
            shown.add_row(*(Text(cell) for cell in row))
        console.print(shown)


def summary_table(measured: Measured) -> Table:
    """One row for each estimator: errors, order, time, efficiency."""
    shown = [n for n in _samples(measured) if n in (4, COMMON, _samples(measured)[-1])]
    target = target_error(measured)
    columns: Columns[Curve] = (
        ("estimator", _name),
        *((f"RMSE at {n}", _rmse_at(n)) for n in shown),
        *COMPARED,
        ("order", lambda curve: _order(curve.order)),
        (f"s at {COMMON}", lambda curve: at(curve, curve.time, COMMON)),
        EFFICIENCY,
        (f"s to {digits(target)}", lambda curve: time_text(curve, target)),
    )
    width, height = measured.size
    title = f"{measured.module.title}, {width} x {height} pixels"
    return table_of(title, measured.curves, columns)


def error_table(measured: Measured) -> Table:
    """RMSE over the number of samples, the order, and what of the last error is bias."""
    columns: Columns[Curve] = (
        ("estimator", _name),
        ("against", lambda curve: curve.estimator.integral),
        *((str(n), _rmse_at(n)) for n in _samples(measured)),
        ("order, 95% interval", lambda curve: order_with_interval(curve.order)),
        ("bias", _bias),
        *COMPARED,
    )
    return table_of(f"{measured.module.title}: RMSE", measured.curves, columns)


def reference_table(measured: Measured) -> Table:
    """What the errors are measured against, and how good that is."""
    columns: Columns[tuple[str, Converged]] = (
        ("reference", lambda named: named[0]),
        ("samples", lambda named: f"{named[1].samples:,}"),
        ("its own RMSE", lambda named: digits(named[1].error)),
        ("hash", lambda named: named[1].key[:12]),
    )
    title = f"{measured.module.title}: references"
    return table_of(title, measured.references.items(), columns)


def time_table(measured: Measured) -> Table:
    """Median seconds over the number of samples, efficiency, and seconds to one and the same error."""
    target = target_error(measured)
    columns: Columns[Curve] = (
        ("estimator", _name),
        *((f"{n} [s]", _time_at(n)) for n in _samples(measured)),
        EFFICIENCY,
        (f"s to RMSE {digits(target)}", lambda curve: time_text(curve, target)),
    )
    return table_of(f"{measured.module.title}: seconds", measured.curves, columns)


def _name(curve: Curve) -> str:
    return curve.estimator.name


def _rmse_at(n: int) -> Callable[[Curve], str]:
    return lambda curve: at(curve, curve.rmse, n)


def _time_at(n: int) -> Callable[[Curve], str]:
    return lambda curve: at(curve, curve.time, n)


COMPARED: Columns[Curve] = (
    (f"rel. MSE at {COMMON}", lambda curve: at(curve, curve.relative_mse.mean(axis=1), COMMON)),
    (f"1 - SSIM at {COMMON}", lambda curve: at(curve, curve.dissimilarity.mean(axis=1), COMMON)),
)
"""Errors other than RMSE, at the number of samples at which estimators are compared."""

EFFICIENCY = (f"efficiency at {COMMON}", lambda curve: at(curve, curve.efficiency, COMMON))


def target_error(measured: Measured) -> float:
    """The error to be reached: that of random samples at COMMON, or of the first estimator if they weren't measured."""
    random = [c for c in measured.curves if c.estimator.sampler == "random"]
    curve = (random or list(measured.curves))[0]
    at_common = [n <= COMMON for n in curve.samples]
    return float(curve.rmse[at_common][-1])


def seconds_to(curve: Curve, error: float) -> float:
    """Seconds to an error, on straight lines between the points in logarithms; NaN if none is below it.

    An estimator that has no larger error takes as long as its first point: `at most`.
    """
    below = np.flatnonzero(curve.rmse <= error * (1 + 1e-9))
    if below.size == 0:
        return math.nan
    number = int(below[0])
    if number == 0:
        return float(curve.time[0])
    e0, e1 = np.log(curve.rmse[number - 1 : number + 1])
    t0, t1 = np.log(curve.time[number - 1 : number + 1])
    return float(np.exp(t0 + (t1 - t0) * (math.log(error) - e0) / (e1 - e0)))


def time_text(curve: Curve, error: float) -> str:
    """`seconds_to` as it stands in a table."""
    seconds = seconds_to(curve, error)
    if math.isnan(seconds):
        return "not reached"
    return f"{'≤ ' if curve.rmse[0] <= error else ''}{digits(seconds)}"


def at(curve: Curve, values: np.ndarray[tuple[int, ...], np.dtype[np.float64]], n: int) -> str:
    """The value at a number of samples; a dash where it wasn't measured."""
    found = np.flatnonzero(curve.samples == n)
    return digits(float(values[found[0]])) if found.size else NONE


def digits(value: float) -> str:
    """Three digits that count, without an exponent."""
    if not math.isfinite(value):
        return NONE
    if value == 0:
        return "0"
    places = 2 - math.floor(math.log10(abs(value)))
    rounded = round(value, places)
    return f"{rounded:,.{max(places, 0)}f}"


def _order(order: ConvergenceOrder | None) -> str:
    return NONE if order is None else f"{order.value:.2f}"


def order_with_interval(order: ConvergenceOrder | None) -> str:
    """An order and its 95% interval, -0.50 (-0.55 .. -0.45); a dash for none."""
    if order is None:
        return NONE
    interval = f"{order.low:.2f} .. {order.high:.2f}"
    return f"{order.value:.2f} ({interval})"


def _bias(curve: Curve) -> str:
    """The last bias; what is less than the reference's own error can't be told from it."""
    if not curve.estimator.biased:
        return NONE
    bias, limit = float(curve.bias[-1]), curve.reference.error
    return f"< {digits(limit)}" if bias < limit else digits(bias)


def _samples(measured: Measured) -> list[int]:
    return sorted({int(n) for curve in measured.curves for n in curve.samples})
