"""Ways to render one scene that differ in one key of it: errors over samples and over seconds.

All ways have the same mean, so they share one converged picture.
"""

from collections.abc import Mapping
from pathlib import Path

from benchmarks.report import report
from course.benchmarking.estimators import Estimator, Module
from course.benchmarking.measuring import Effort, measure
from course.benchmarking.plot_data import comparisons
from course.benchmarking.tables import summary_table
from course.effects import PROJECT

REFERENCES = Path("out/references")


def compare_ways(
    module: str,
    sampler: str,
    key: tuple[str | int, ...],
    ways: Mapping[str, str],
    title: str,
    effort: Effort,
) -> None:
    """Measure, print and draw the curves.

    Parameters
    ----------
    module : whose scene it is
    key : of the scene file
    ways : what each is called -> the key's value
    title : of the plot
    """
    estimators = tuple(
        Estimator(name, sampler, "as the scene", ("ways",), {key: way})
        for name, way in ways.items()
    )
    scene = PROJECT / "scenes" / f"{module}.yaml"
    one = Module(module, scene, {"ways": title}, estimators)
    measured = measure(one, estimators, effort, folder=REFERENCES)
    width, height = measured.size
    about = f"{width} x {height} pixels, {effort.seeds} seeds"
    report(module, about, [summary_table(measured)], comparisons(measured))
