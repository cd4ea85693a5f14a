"""`make bench`: measure the engine and print what was found beside what it must reach; then `course bench`.

Nearly every figure is a ratio within this run: absolute times mean little from one machine, or one minute, to the
next. Nothing here decides a test.
"""

import compileall
import json
import os
from importlib.util import find_spec
from pathlib import Path

import click

from benchmarks.adaptive import measure_adaptive
from benchmarks.adaptive_sampling import measure_adaptive_sampling
from benchmarks.allocation_oracle import measure_oracle
from benchmarks.blue_noise import measure_blue_noise
from benchmarks.bounding_volumes import measure_bounding_volumes
from benchmarks.convergence import measure_convergence
from benchmarks.denoising import measure_denoising
from benchmarks.engine import measure_degenerate, measure_dragons, measure_effects, measure_engine
from benchmarks.environment_light import measure_environment_light
from benchmarks.false_alarms import measure_false_alarms
from benchmarks.figures import Figure, table, write_ratios
from benchmarks.grading import measure_grading
from benchmarks.importance_sampling import measure_importance_sampling
from benchmarks.many_lights import measure_many_lights
from benchmarks.media import measure_media
from benchmarks.microfacets import measure_microfacets
from benchmarks.multiple_importance import measure_multiple_importance
from benchmarks.own_functions import measure_own_functions
from benchmarks.path_tracing import measure_path_tracing
from benchmarks.photon_mapping import measure_photon_mapping
from benchmarks.process import measure_processes
from benchmarks.quasi_monte_carlo import measure_quasi_monte_carlo
from benchmarks.radiosity import measure_radiosity
from benchmarks.reached_error import measure_quickly, measure_reached_error
from benchmarks.report import publish
from benchmarks.sampling import measure_sampling
from benchmarks.scaling import measure_scaling, write_scaling
from benchmarks.told_errors import measure_told_errors
from course.benchmarking.machine import machine
from course.benchmarking.tables import print_tables
from course.cli.bench import DOCUMENTS, bench
from course.engine.functions.effects import PROJECT

OUT = Path("out/bench")
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
    "radiosity": measure_radiosity,
    "bounding_volumes": measure_bounding_volumes,
    "grading": measure_grading,
    "path_tracing": measure_path_tracing,
    "sampling": measure_sampling,
    "adaptive_sampling": measure_adaptive_sampling,
    "importance_sampling": measure_importance_sampling,
    "multiple_importance": measure_multiple_importance,
    "environment_light": measure_environment_light,
    "microfacets": measure_microfacets,
    "media": measure_media,
    "photon_mapping": measure_photon_mapping,
    "many_lights": measure_many_lights,
    "denoising": measure_denoising,
    "quasi_monte_carlo": measure_quasi_monte_carlo,
    "blue_noise": measure_blue_noise,
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
