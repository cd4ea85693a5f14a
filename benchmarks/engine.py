"""The whole render against the time inside Embree, and two threads against one."""

from __future__ import annotations

from pathlib import Path

from benchmarks.figures import Figure, summary
from course import load_scene, render

SCENES = Path(__file__).parent / "scenes"
REPETITIONS = 7


def measure_engine() -> list[Figure]:
    """Ratios of two scenes, one and two threads in turn."""
    figures = []
    for name, goal in (("direct_light", 1.5), ("mirrors_and_glass", 2.2)):
        scene = load_scene(SCENES / f"{name}.yaml")
        render(scene, threads=2, compiled=False)
        ratios, alone, speedups = [], [], []
        for _ in range(REPETITIONS):
            one = render(scene, threads=1, compiled=False).receipt
            two = render(scene, threads=2, compiled=False).receipt
            ratios.append(two.wall_seconds * 2 / two.embree_seconds)
            alone.append(one.wall_seconds / one.embree_seconds)
            speedups.append(one.wall_seconds / two.wall_seconds)
        figures.append(summary(f"{name}: 2 x wall clock / inside Embree", ratios, goal))
        figures.append(summary(f"{name}: the same with one thread", alone, goal))
        figures.append(summary(f"{name}: one thread / two threads", speedups, 1.85, at_least=True))
    return figures
