"""Light from a sky with a small sun: errors of four ways to choose directions, over samples and over seconds."""

from benchmarks.figures import Figure
from benchmarks.ways import compare_ways
from course.benchmarking.measuring import Effort

CURVES = Effort("curves", 64, (1, 4, 16, 64, 256), 4, 4096)
WAYS = {
    "by the cosine": "cosine",
    "by inversion": "inversion",
    "by an alias table": "alias",
    "by picture and cosine (automatic)": "automatic",
}


def measure_environment_light() -> list[Figure]:
    """Measure, print and draw the curves."""
    title = "four ways to choose directions, Sobol points"
    compare_ways("environment_light", "sobol", ("environment", "sampling"), WAYS, title, CURVES)
    return []
