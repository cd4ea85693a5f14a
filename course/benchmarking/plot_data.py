"""The numbers behind the plots of the documentation, in files that are kept with it.

A file in docs/data maps modules to what was measured of them; nothing in it depends on the day. Building the site draws
the plots from these numbers.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from math import isfinite
from pathlib import Path
from typing import Any

from course.atomic import write_text
from course.errors import CourseError, OutputError

DIGITS = 6
"""Digits that count of a number in a file: enough for the three that are shown to be rounded once."""


@dataclass(frozen=True)
class Series:
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
    x: Mapping[str, tuple[float, ...]]
    y: tuple[float, ...]
    order: float | None = None
    limit: float | None = None
    predicted: bool = False


@dataclass(frozen=True)
class Plot:
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
    axes: Mapping[str, str]
    y: str
    series: tuple[Series, ...]
    floor: float | None = None
    slope: bool = True


@dataclass(frozen=True)
class Record:
    """What was measured of a module.

    Attributes
    ----------
    command : that measures it again
    about : with what effort
    machine : what it was measured with, name -> value
    """

    command: str
    about: str
    machine: Mapping[str, str]
    plots: tuple[Plot, ...]


def rounded(value: float) -> float:
    """The number with the digits that count."""
    return float(f"{value:.{DIGITS}g}")


def write_records(path: Path, records: Mapping[str, Record]) -> None:
    """Put modules into a data file; others that it holds stay.

    Raises
    ------
    OutputError
        The file holds something else, or can't be written.
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

    Raises
    ------
    CourseError
        The file can't be read, or holds something else.
    """
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        return {name: _record(record) for name, record in data.items()}
    except OSError as error:
        raise CourseError(f"{path}: can't be read: {error.strerror}") from error
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise OutputError(
            f"{path}: isn't a data file of the benchmarks ({error}); remove it and measure again"
        ) from error


def _plain(record: Record) -> dict[str, Any]:
    data = asdict(record)
    for plot in data["plots"]:
        _trim(plot, floor=None, slope=True)
        for series in plot["series"]:
            _trim(series, order=None, limit=None, predicted=False)
            _drawable(series)
    return data


def _trim(data: dict[str, Any], **defaults: Any) -> None:
    """Leave out what is as it is by default, and round the rest."""
    for name, default in defaults.items():
        if data[name] == default:
            del data[name]
        elif isinstance(data[name], float):
            data[name] = rounded(data[name])


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


def _record(data: dict[str, Any]) -> Record:
    plots = tuple(
        Plot(**{**plot, "series": tuple(_series(series) for series in plot["series"])})
        for plot in data["plots"]
    )
    return Record(**{**data, "plots": plots})


def _series(data: dict[str, Any]) -> Series:
    x = {axis: tuple(values) for axis, values in data["x"].items()}
    return Series(**{**data, "x": x, "y": tuple(data["y"])})
