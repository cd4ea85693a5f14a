"""What a scene costs with a student's functions, over what it costs with the course's: ratios of processor time.

The functions are copies of the solutions in a folder of their own, so that nobody knows them to be the course's: they
are called through their contracts, and compiled loops have no forms of them.
"""

import shutil
from collections.abc import Callable
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import process_time

from benchmarks.engine import EFFECTS
from benchmarks.figures import Figure, summary
from course import Scene, load_scene, render
from course.engine.functions.effects import PROJECT
from course.engine.loops.embree_device import available

ROUNDS, SAMPLES, SIZE = 5, 16, (300, 200)
GOAL = 1.1


def measure_own_functions() -> list[Figure]:
    """Pairs in turn, one thread, by batches of NumPy and compiled."""
    with TemporaryDirectory() as folder:
        for file in (PROJECT / "solutions").glob("*.py"):
            shutil.copy(file, folder)
        return [
            summary(f"{name}: a student's functions / the course's, {form}", ratios, GOAL)
            for name in EFFECTS
            for form, ratios in _ratios(name, Path(folder))
        ]


def _ratios(name: str, folder: Path) -> list[tuple[str, list[float]]]:
    path = PROJECT / "scenes" / f"{name}.yaml"
    courses, own = load_scene(path), load_scene(path, folder)
    found = []
    for form, compiled in (("NumPy", False), ("compiled", True))[: 1 + available()]:
        seconds = _seconds(compiled)
        for scene in (courses, own):
            seconds(scene, 0)
        pairs = [(seconds(courses, seed), seconds(own, seed)) for seed in range(ROUNDS)]
        found.append((form, [b / a for a, b in pairs]))
        print(f"{name}, {form}: {median(found[-1][1]):.2f}", flush=True)
    return found


def _seconds(compiled: bool) -> Callable[[Scene, int], float]:
    def seconds(scene: Scene, seed: int) -> float:
        began = process_time()
        render(scene, spp=SAMPLES, size=SIZE, threads=1, compiled=compiled, seed=seed)
        return process_time() - began

    return seconds
