"""Light from a sky with a small sun: errors of four ways to choose directions, over samples and over seconds."""

from benchmarks.figures import Figure
from benchmarks.ways import compare_ways, gain
from course.benchmarking.measuring import Effort

CURVES = Effort("curves", 64, (1, 4, 16, 64, 256), 4, 4096)
WAYS = {
    "by the cosine": "cosine",
    "by inversion": "inversion",
    "by an alias table": "alias",
    "by picture and cosine (automatic)": "automatic",
}
AT, GOAL = 16, 5.0
"""Samples at which ways are compared, and how many times smaller the error is to be than by the cosine."""


def measure_environment_light() -> list[Figure]:
    """Measure, print and draw the curves; what each way gains over the cosine in equal time."""
    title = "four ways to choose directions, Sobol points"
    key = ("environment", "sampling")
    measured = compare_ways("environment_light", "sobol", key, WAYS, title, CURVES)
    cosine, *others = WAYS
    return [gain(measured, cosine, other, AT, GOAL) for other in others]
