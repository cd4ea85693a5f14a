"""Data files of the modules' own curves: kept in out/bench/data when they are measured, put into docs/data when asked.

The site draws its plots from the latter; see `course.benchmarking.plot_data`.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from course.benchmarking.machine import machine
from course.benchmarking.plot_data import Plot, Record, read_records, write_records

KEPT = Path("out/bench/data")


def keep(name: str, about: str, plots: Sequence[Plot], folder: Path = KEPT) -> Path:
    """Keep the curves of a benchmark.

    Parameters
    ----------
    name : of the benchmark and of the module whose page shows them
    about : with what effort they were measured
    """
    command = f"python -m benchmarks {name} --write-docs"
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.json"
    path.unlink(missing_ok=True)
    write_records(path, {name: Record(command, about, machine(), tuple(plots))})
    print(f"written to {path}")
    return path


def publish(names: Sequence[str], to: Path, kept: Path = KEPT) -> list[Path]:
    """Put the curves of those benchmarks that have any into the documentation's folder of data."""
    to.mkdir(exist_ok=True)
    written = []
    for name in names:
        if (kept / f"{name}.json").is_file():
            write_records(to / f"{name}.json", read_records(kept / f"{name}.json"))
            written.append(to / f"{name}.json")
    return written
