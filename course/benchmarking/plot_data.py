"""The numbers behind the plots of the documentation, in files that are kept with it.

A file in docs/data maps modules to what was measured of them: each comparison over samples and over seconds. Nothing in
it depends on the day. Building the site draws the plots from these numbers.
"""

import json
import re
from collections.abc import Mapping, Sequence
from math import isfinite
from pathlib import Path
from typing import Any

import msgspec

from course.base.atomic import write_text
from course.base.errors import CourseError, OutputError
from course.benchmarking.curves import Curve
from course.benchmarking.measuring import FULL, QUICK, Effort, Measured

DIGITS = 6
"""Digits that count of a number in a file: enough for the three that are shown to be rounded once."""


class Series(msgspec.Struct, frozen=True, omit_defaults=True):
    """A line of a plot.

    Attributes
    ----------
    name : of the estimator
    style : number of its colour and its mark
    x : name of an axis -> values along it; counts are of type int
    y : as many values
    order : the fitted order, if there is one
    limit : the error that is left however large x is, if it can be told from noise
    predicted : whether it was computed and not measured
    """

    name: str
    style: int
    x: dict[str, tuple[int | float, ...]]
    y: tuple[int | float, ...]
    order: float | None = None
    limit: float | None = None
    predicted: bool = False


class Plot(msgspec.Struct, frozen=True, omit_defaults=True):
    """A comparison.

    Attributes
    ----------
    name : as the site's pages ask for it
    title : what is compared
    axes : name of an axis -> what it shows; "seconds" is one over time
    y : what the values are
    series : the lines, each with values along every axis
    floor : error of the reference itself, if there is one
    slope : whether a line of order -1/2 is of use beside them
    """

    name: str
    title: str
    axes: dict[str, str]
    y: str
    series: tuple[Series, ...]
    floor: float | None = None
    slope: bool = True


class Record(msgspec.Struct, frozen=True):
    """The measurements of a module.

    Attributes
    ----------
    command : that measures it again
    about : with what effort
    machine : what it was measured with, name -> value
    """

    command: str
    about: str
    machine: dict[str, str]
    plots: tuple[Plot, ...]


def rounded(value: float) -> float:
    """The number with the digits that count."""
    return float(f"{value:.{DIGITS}g}")


def write_records(path: Path, records: Mapping[str, Record]) -> None:
    """Put modules into a data file; others that it holds stay.

    Raises OutputError: the file holds something else, or can't be written.
    """
    kept = read_records(path) if path.is_file() else {}
    data = {name: _plain(record) for name, record in {**kept, **records}.items()}
    text = json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False)
    # A list of numbers is one line.
    text = re.sub(
        r"\[\s+([-+.\de,\s]+?)\s+\]", lambda found: f"[{' '.join(found[1].split())}]", text
    )
    write_text(path, text + "\n")


def read_records(path: Path) -> dict[str, Record]:
    """Read what `write_records` wrote.

    Raises CourseError: the file can't be read, or holds something else.
    """
    try:
        return msgspec.json.decode(path.read_bytes(), type=dict[str, Record])
    except OSError as error:
        raise CourseError(f"{path}: can't be read: {error.strerror}") from error
    except msgspec.DecodeError as error:
        raise OutputError(
            f"{path}: isn't a data file of the benchmarks ({error}); remove it and measure again"
        ) from error


def _plain(record: Record) -> Any:
    """Plain data, numbers rounded, without what is as it is by default."""
    data = msgspec.to_builtins(record)
    for plot in data["plots"]:
        for part in (plot, *plot["series"]):
            part.update(
                (key, rounded(part[key])) for key in ("floor", "order", "limit") if key in part
            )
        for series in plot["series"]:
            _drawable(series)
    return data


def _drawable(series: dict[str, Any]) -> None:
    """Leave out points that have no place on logarithmic axes; round the others."""
    columns = [*series["x"].values(), series["y"]]
    rows = [row for row in zip(*columns, strict=True) if all(isfinite(v) and v > 0 for v in row)]
    kept = [[_number(row[place]) for row in rows] for place in range(len(columns))]
    series["x"] = dict(zip(series["x"], kept, strict=False))
    series["y"] = kept[-1]


def _number(value: float) -> float:
    """A count as it is, a measurement rounded."""
    return value if isinstance(value, int) else rounded(value)


STYLES = {"regular": 3, "random": 0, "jittered": 1, "sobol": 2}
"""Each sampler has the same colour and mark in all plots."""


def record(measured: Measured, effort: Effort, machine: Mapping[str, str]) -> Record:
    """The plots of a module, as data files keep them."""
    return Record(
        command(measured.module.name, effort),
        about(measured, effort),
        dict(machine),
        comparisons(measured),
    )


def about(measured: Measured, effort: Effort) -> str:
    """With what effort a module was measured."""
    width, height = measured.size
    seeds = "1 seed" if effort.seeds == 1 else f"{effort.seeds} seeds"
    return f"{width} x {height} pixels, {seeds}"


def command(module: str, effort: Effort) -> str:
    """The line that measures a module and writes it into the documentation."""
    words = ["course bench", module, "--write-docs"]
    words += ["--quick"] if effort.name == QUICK.name else []
    usual = QUICK if effort.name == QUICK.name else FULL
    words += [f"--height {effort.height}"] if effort.height != usual.height else []
    return " ".join(words)


def comparisons(measured: Measured) -> tuple[Plot, ...]:
    """A plot for each comparison of which something was measured."""
    return tuple(
        _plot(group, title, measured.group(group))
        for group, title in measured.module.groups.items()
        if measured.group(group)
    )


def _plot(group: str, title: str, curves: Sequence[Curve]) -> Plot:
    points = any(curve.estimator.points > 1 for curve in curves)
    axes = {
        "samples": "shadow rays for each pixel" if points else "samples for each pixel",
        "seconds": "seconds",
    }
    series = tuple(_series_of(group, number, curve) for number, curve in enumerate(curves))
    floor = max(curve.reference.error for curve in curves)
    return Plot(group, title, axes, "RMSE", series, floor if floor > 0 else None)


def _series_of(group: str, number: int, curve: Curve) -> Series:
    samples = curve.samples * curve.estimator.points
    bias = float(curve.bias[-1])
    grid = curve.estimator.points > 1
    # The order of what ends at a floor says nothing.
    order = None if grid else curve.order
    return Series(
        curve.estimator.label(group),
        STYLES[curve.estimator.sampler] if group == "samplers" else number,
        {"samples": tuple(map(int, samples)), "seconds": tuple(curve.time.tolist())},
        tuple(curve.rmse.tolist()),
        order=None if order is None else order.value,
        limit=bias if grid and bias >= 2 * curve.reference.error else None,
    )
