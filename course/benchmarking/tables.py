"""Tables of what was measured: for the terminal, and as Markdown for the documentation."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable
from dataclasses import dataclass

import click
import numpy as np

from course.benchmarking.curves import Curve
from course.benchmarking.measuring import Measured
from course.benchmarking.orders import Order

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
    columns = (
        "estimator",
        *(f"RMSE at {n}" for n in shown),
        f"rel. MSE at {COMMON}",
        f"1 - SSIM at {COMMON}",
        "order",
        f"s at {COMMON}",
        f"efficiency at {COMMON}",
        f"s to {digits(target)}",
    )
    rows = tuple(
        (
            curve.estimator.name,
            *(at(curve, curve.rmse, n) for n in shown),
            at(curve, curve.relative_mse.mean(axis=1), COMMON),
            at(curve, curve.dissimilarity.mean(axis=1), COMMON),
            _order(curve.order),
            at(curve, curve.time, COMMON),
            at(curve, curve.efficiency, COMMON),
            time_text(curve, target),
        )
        for curve in measured.curves
    )
    width, height = measured.size
    return Table(f"{measured.module.title}, {width} x {height} pixels", columns, rows)


def error_table(measured: Measured) -> Table:
    """RMSE over the number of samples, the order, and what of the last error is bias."""
    samples = _samples(measured)
    columns = (
        "estimator",
        "against",
        *map(str, samples),
        "order, 95% interval",
        "bias",
        f"rel. MSE at {COMMON}",
        f"1 - SSIM at {COMMON}",
    )
    rows = tuple(
        (
            curve.estimator.name,
            curve.estimator.integral,
            *(at(curve, curve.rmse, n) for n in samples),
            _order_with_interval(curve.order),
            _bias(curve),
            at(curve, curve.relative_mse.mean(axis=1), COMMON),
            at(curve, curve.dissimilarity.mean(axis=1), COMMON),
        )
        for curve in measured.curves
    )
    return Table(f"{measured.module.title}: RMSE", columns, rows)


def reference_table(measured: Measured) -> Table:
    """What the errors are measured against, and how good that is."""
    rows = tuple(
        (name, f"{item.samples:,}", digits(item.error), item.key[:12])
        for name, item in measured.references.items()
    )
    columns = ("reference", "samples", "its own RMSE", "hash")
    return Table(f"{measured.module.title}: references", columns, rows)


def time_table(measured: Measured) -> Table:
    """Median seconds over the number of samples, efficiency, and seconds to one and the same error."""
    samples = _samples(measured)
    target = target_error(measured)
    columns = (
        "estimator",
        *(f"{n} [s]" for n in samples),
        f"efficiency at {COMMON}",
        f"s to RMSE {digits(target)}",
    )
    rows = tuple(
        (
            curve.estimator.name,
            *(at(curve, curve.time, n) for n in samples),
            at(curve, curve.efficiency, COMMON),
            time_text(curve, target),
        )
        for curve in measured.curves
    )
    return Table(f"{measured.module.title}: seconds", columns, rows)


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


def _order(order: Order | None) -> str:
    return NONE if order is None else f"{order.value:.2f}"


def _order_with_interval(order: Order | None) -> str:
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
