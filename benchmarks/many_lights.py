"""A thousand lamps, of which one is asked for each hit: errors of three choices, over samples and over seconds.

The samples of the converged picture are chosen by the tree.
"""

from benchmarks.figures import Figure
from benchmarks.ways import compare_ways
from course.benchmarking.measuring import Effort

CURVES = Effort("curves", 40, (1, 4, 16, 64, 256), 4, 4096)
WAYS = {"each as probable": "uniform", "by power": "power", "by a light tree": "tree"}


def measure_many_lights() -> list[Figure]:
    """Measure, print and draw the curves."""
    key = ("integrator", "light_sampling")
    title = "three ways to choose one of a thousand lamps, random points"
    compare_ways("many_lights", "random", key, WAYS, title, CURVES)
    return []
