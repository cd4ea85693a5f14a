"""Seconds for a picture of the kind that lectures quote a time for."""

from __future__ import annotations

from benchmarks.engine import SCENES
from benchmarks.figures import Figure, summary
from course import load_scene, render

QUOTED = 351
"""Seconds that a lecture quotes for two meshes of 100,000 triangles, one moving, an area light, a reflecting floor,
800 x 480 pixels, 100 samples each."""

REPETITIONS = 3


def measure_dragons() -> list[Figure]:
    """The whole render, without loading the scene."""
    scene = load_scene(SCENES / "dragons.yaml")
    render(scene, spp=1)
    seconds = [render(scene).receipt.wall_seconds for _ in range(REPETITIONS)]
    return [summary(f"dragons: seconds (a lecture quotes {QUOTED})", seconds, QUOTED)]
