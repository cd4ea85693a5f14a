"""Ways to render one scene that differ in one key of it: errors over samples and over seconds.

All ways have the same mean, so they share one converged picture.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from benchmarks.figures import Figure
from benchmarks.report import report
from course.benchmarking.estimators import Estimator, Module
from course.benchmarking.measuring import Effort, Measured, measure
from course.benchmarking.plot_data import Plot, comparisons
from course.benchmarking.tables import Table, summary_table
from course.engine.functions.effects import PROJECT

REFERENCES = Path("out/references")


def compare_ways(
    module: str,
    sampler: str,
    key: tuple[str | int, ...],
    ways: Mapping[str, str],
    title: str,
    effort: Effort,
    tables: Sequence[Table] = (),
    plots: Sequence[Plot] = (),
) -> Measured:
    """Measure, print and draw the curves.

    Parameters
    ----------
    module : whose scene it is
    key : of the scene file
    ways : what each is called -> the key's value
    title : of the plot
    tables, plots : of other measurements, to be shown behind these
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
    report(module, about, [summary_table(measured), *tables], [*comparisons(measured), *plots])
    return measured


def gain(measured: Measured, worse: str, better: str, samples: int, goal: float) -> Figure:
    """How many times the error of a better way a worse one has in the time that the better takes, seed by seed.

    The worse way's error falls with the root of its samples: independent numbers, or too few to be even.
    """
    curves = {curve.estimator.variant: curve for curve in measured.curves}
    one, other = curves[worse], curves[better]
    at = one.samples.tolist().index(samples)
    shorter = np.median(other.seconds[at]) / np.median(one.seconds[at])
    each = np.sqrt(one.mse[at] / other.mse[at] / shorter)
    name = f"{measured.module.name}: error in equal time at {samples} samples, {worse} / {better}"
    values = float(np.median(each)), float(each.min()), float(each.max())
    return Figure(name, *values, goal, at_least=True)
