"""`make bench`: measure the engine and print what was found beside what it must reach; then `course bench`.

Nearly every figure is a ratio within this run: absolute times mean little from one machine, or one minute, to the
next. Nothing here decides a test.
"""

import compileall
import json
import os
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

import click

from benchmarks.adaptive import measure_adaptive
from benchmarks.allocation_oracle import measure_oracle
from benchmarks.convergence import measure_convergence
from benchmarks.engine import measure_degenerate, measure_dragons, measure_effects, measure_engine
from benchmarks.false_alarms import measure_false_alarms
from benchmarks.figures import Figure, table, write_ratios
from benchmarks.grading import measure_grading
from benchmarks.own_functions import measure_own_functions
from benchmarks.process import measure_processes
from benchmarks.reached_error import measure_quickly, measure_reached_error
from benchmarks.report import publish
from benchmarks.scaling import measure_scaling, write_scaling
from benchmarks.told_errors import measure_told_errors
from course.benchmarking.machine import machine
from course.benchmarking.tables import print_tables
from course.cli.bench import DOCUMENTS, bench
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import TAUGHT

OUT = Path("out/bench")


def _of_modules() -> dict[str, Callable[[], list[Figure]]]:
    """What files here that are called as modules of the course measure: NAME.py has ``measure_NAME``."""
    here = Path(__file__).parent
    return {
        name: getattr(import_module(f"benchmarks.{name}"), f"measure_{name}")
        for name in TAUGHT
        if (here / f"{name}.py").is_file()
    }


MEASURES = {
    "engine": measure_engine,
    "effects": measure_effects,
    "own_functions": measure_own_functions,
    "degenerate": measure_degenerate,
    "process": measure_processes,
    "scaling": measure_scaling,
    "convergence": measure_convergence,
    "dragons": measure_dragons,
    "adaptive": measure_adaptive,
    "reached_error": measure_reached_error,
    "told_errors": measure_told_errors,
    "allocation_oracle": measure_oracle,
    **_of_modules(),
    "grading": measure_grading,
    "false_alarms": measure_false_alarms,
}


@click.command(
    help="Measure everything, or what NAME says; print and write it.\n\n"
    f"NAME: {', '.join(MEASURES)}, or errors (`course bench`)."
)
@click.argument("names", metavar="[NAME]...", nargs=-1, type=click.Choice([*MEASURES, "errors"]))
@click.option(
    "--quick", is_flag=True, help="Measure errors over time, and reached_error, in about a minute."
)
@click.option(
    "--write-docs",
    is_flag=True,
    help="Write the table into docs/performance.md and the numbers of plots into docs/data, too.",
)
def main(names: tuple[str, ...], quick: bool, write_docs: bool) -> None:
    """Do what the command line asks for."""
    OUT.mkdir(parents=True, exist_ok=True)
    _keep_bytecode()
    measures = {**MEASURES, **({"reached_error": measure_quickly} if quick else {})}
    found = {name: measure() for name, measure in measures.items() if not names or name in names}
    if found:
        _report(found, write_docs)
    if not names or "errors" in names:
        arguments = ["--json", str(OUT / "errors.json")]
        # Plots take an extra.
        arguments += ["--plots", str(OUT / "plots")] if find_spec("matplotlib") else []
        arguments += ["--quick"] if quick else []
        arguments += ["--write-docs"] if write_docs else []
        bench.main(arguments, prog_name="course bench", standalone_mode=False)


def _keep_bytecode() -> None:
    """Measure processes as they start on a machine where the course is installed: compiled long before.

    An environment that forbids Python to write bytecode makes each of them compile what has changed since: up to half
    of the time that a small picture takes.
    """
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    compileall.compile_dir(str(PROJECT / "course"), quiet=1)


def _report(found: dict[str, list[Figure]], write_docs: bool) -> None:
    figures = [figure for part in found.values() for figure in part]
    print_tables([table(figures)])
    made_with = machine()
    path = OUT / "engine.json"
    path.write_text(json.dumps({**made_with, "figures": [f.to_dict() for f in figures]}, indent=2))
    print(f"written to {path}")
    if write_docs:
        publish(list(found), DOCUMENTS / "data")
        write_ratios(found, made_with, DOCUMENTS, MEASURES)
        if "scaling" in found:
            write_scaling(made_with, DOCUMENTS)


if __name__ == "__main__":
    main()
