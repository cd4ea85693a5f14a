"""Light from a sky with a small sun: errors of four ways to choose directions, over samples and over seconds.

All ways have the same mean, so they share one converged picture.
"""

from pathlib import Path

from benchmarks.figures import Figure
from benchmarks.report import report
from course.benchmarking.estimators import Estimator, Module
from course.benchmarking.measuring import Effort, Measured, measure
from course.benchmarking.plot_data import comparisons
from course.benchmarking.tables import summary_table
from course.effects import PROJECT

SCENE = PROJECT / "scenes" / "environment_light.yaml"
CURVES = Effort("curves", 64, (1, 4, 16, 64, 256), 4, 4096)
WAYS = {
    "by the cosine": "cosine",
    "by inversion": "inversion",
    "by an alias table": "alias",
    "by picture and cosine (automatic)": "automatic",
}


def measure_environment_light() -> list[Figure]:
    """Measure, print and draw the curves."""
    measured = curves(CURVES)
    width, height = measured.size
    about = f"{width} x {height} pixels, {CURVES.seeds} seeds"
    report("environment_light", about, [summary_table(measured)], comparisons(measured))
    return []


def curves(effort: Effort, folder: Path = Path("out/references")) -> Measured:
    """The errors and times of every way; the reference goes into the folder."""
    estimators = [
        Estimator(name, "sobol", "as the scene", ("ways",), {("environment", "sampling"): way})
        for name, way in WAYS.items()
    ]
    groups = {"ways": "four ways to choose directions, Sobol points"}
    module = Module("environment_light", SCENE, groups, tuple(estimators))
    return measure(module, module.estimators, effort, folder=folder)
