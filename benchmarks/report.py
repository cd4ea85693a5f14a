"""What a module's benchmark shows of its measurements: tables, figures for lectures, and data for the site's plots."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from importlib.util import find_spec
from pathlib import Path

from benchmarks.curve_files import keep
from course.benchmarking.plot_data import Plot
from course.benchmarking.plots import write_plots
from course.benchmarking.tables import Table, print_tables

OUT = Path("out/bench")


def report(name: str, about: str, tables: Iterable[Table], plots: Sequence[Plot]) -> None:
    """Print tables; draw plots as `out/bench/NAME_PLOT_AXIS.svg`; keep their numbers in `out/bench/data/NAME.json`.

    Without matplotlib, which is an extra, there are no figures.

    Parameters
    ----------
    name : of the benchmark and of the module whose page shows the plots
    about : with what effort they were measured
    """
    print_tables(tables)
    if find_spec("matplotlib"):
        OUT.mkdir(parents=True, exist_ok=True)
        for path in write_plots(name, plots, about, OUT):
            print(f"written to {path}")
    keep(name, about, plots)
