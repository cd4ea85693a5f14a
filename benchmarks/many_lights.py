"""A thousand lamps, of which one is asked for each hit: errors of three choices, over samples and over seconds.

All ways have the same mean, so they share one converged picture, whose samples are chosen by the tree.
"""

from pathlib import Path

from benchmarks.figures import Figure
from benchmarks.report import report
from course.benchmarking.estimators import Estimator, Module
from course.benchmarking.measuring import Effort, Measured, measure
from course.benchmarking.plot_data import comparisons
from course.benchmarking.tables import summary_table
from course.effects import PROJECT

SCENE = PROJECT / "scenes" / "many_lights.yaml"
CURVES = Effort("curves", 40, (1, 4, 16, 64, 256), 4, 4096)
WAYS = {"each as probable": "uniform", "by power": "power", "by a light tree": "tree"}


def measure_many_lights() -> list[Figure]:
    """Measure, print and draw the curves."""
    measured = curves(CURVES)
    width, height = measured.size
    about = f"{width} x {height} pixels, {CURVES.seeds} seeds"
    report("many_lights", about, [summary_table(measured)], comparisons(measured))
    return []


def curves(effort: Effort, folder: Path = Path("out/references")) -> Measured:
    """The errors and times of every way; the reference goes into the folder."""
    estimators = [
        Estimator(
            name, "random", "as the scene", ("ways",), {("integrator", "light_sampling"): way}
        )
        for name, way in WAYS.items()
    ]
    groups = {"ways": "three ways to choose one of a thousand lamps, random points"}
    module = Module("many_lights", SCENE, groups, tuple(estimators))
    return measure(module, module.estimators, effort, folder=folder)
