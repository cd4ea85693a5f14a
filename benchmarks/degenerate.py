"""What the keys of effects cost where they do nothing: an aperture, velocities, roughness or a radius of 0."""

from __future__ import annotations

from pathlib import Path

from benchmarks.engine import SCENES
from benchmarks.figures import Figure, summary
from course import Scene, render
from course.formats.yaml.overriding import Overrides
from course.scene.scene import load_variant

REPETITIONS = 15
STILL = {"velocity": [0, 0, 0]}
LENS: Overrides = {("camera", "lens"): {"aperture_radius": 0, "focus_point": [0, 0.5, 0]}}
MOTION: Overrides = {
    ("camera", "motion"): STILL,
    ("lights", 0, "motion"): STILL,
    **{("objects", number, "motion"): STILL for number in range(4)},
}
GLOSS: Overrides = {
    ("materials", "floor", "gloss"): {"lobe": "plane", "roughness": 0},
    ("materials", "mirror", "gloss"): {"lobe": "ball", "glossiness": 0},
}
RADIUS: Overrides = {("lights", 0, "radius"): 0}
POINT: Overrides = {("lights", 0): {"type": "point", "position": [1.5, 4, 4], "intensity": 80}}
PAIRS: tuple[tuple[str, str, Overrides, Overrides], ...] = (
    ("aperture 0", "direct_light", LENS, {}),
    ("velocity 0", "direct_light", MOTION, {}),
    ("roughness 0", "mirrors_and_glass", GLOSS, {}),
    ("radius 0", "direct_light", RADIUS, POINT),
    ("all of them 0", "mirrors_and_glass", LENS | MOTION | GLOSS | RADIUS, POINT),
)
"""Name, scene, keys that do nothing, and what the scene is without them."""


def measure_degenerate() -> list[Figure]:
    """Ratios of renders with such keys and without, in turn; the pictures are the same bits."""
    return [
        _figure(f"{name}: with the keys / without", SCENES / f"{scene}.yaml", keys, without)
        for name, scene, keys, without in PAIRS
    ]


def _figure(name: str, path: Path, keys: Overrides, without: Overrides) -> Figure:
    scenes = load_variant(path, keys), load_variant(path, without)
    for scene in scenes:
        render(scene, compiled=False)
    ratios = []
    for number in range(REPETITIONS):
        # The other one first every other time, so that a drift of the clock favours neither.
        first = number % 2
        seconds = {which: _seconds(scenes[which]) for which in (first, 1 - first)}
        ratios.append(seconds[0] / seconds[1])
    return summary(name, ratios, 1.02)


def _seconds(scene: Scene) -> float:
    return render(scene, compiled=False).receipt.wall_seconds
