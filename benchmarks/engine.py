"""The whole render against the time inside Embree, and two threads against one; what effects cost.

Also what their keys cost where they do nothing, and a picture of the kind that lectures quote a time for.
"""

from pathlib import Path

from benchmarks.figures import Figure, summary
from course import Scene, load_scene, render
from course.engine.formats.yaml.overriding import Overrides
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_variant

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


EFFECTS = ("supersampling", "soft_shadows", "glossy", "thin_lens", "motion_blur", "cube_map")
EFFECT_ROUNDS = 5


def measure_effects() -> list[Figure]:
    """Ratios on two threads."""
    figures = [_embree_bound(name) for name in EFFECTS]
    plain = load_scene(SCENES / "direct_light.yaml")
    for name in ("lens", "motion"):
        with_effect = load_scene(SCENES / f"direct_light_{name}.yaml")
        render(plain, compiled=False)
        render(with_effect, compiled=False)
        added = []
        for _ in range(EFFECT_ROUNDS):
            own, embree = _outside_and_inside(plain)
            own_with, _ = _outside_and_inside(with_effect)
            added.append((own_with - own) / (own + embree))
        figures.append(
            summary(f"{name}: what it adds outside Embree / the whole render without", added, 0.15)
        )
    return figures


def _embree_bound(name: str) -> Figure:
    scene = load_scene(PROJECT / "scenes" / f"{name}.yaml")
    size = (400, 300)
    render(scene, size=size, spp=16, compiled=False)
    ratios = []
    for _ in range(EFFECT_ROUNDS):
        receipt = render(scene, size=size, spp=16, compiled=False).receipt
        ratios.append(receipt.wall_seconds * receipt.threads / receipt.embree_seconds)
    return summary(f"scenes/{name}: threads x wall clock / inside Embree", ratios, 1.9)


def _outside_and_inside(scene: Scene) -> tuple[float, float]:
    """Seconds of all threads outside and inside Embree."""
    receipt = render(scene, compiled=False).receipt
    whole = receipt.wall_seconds * receipt.threads
    return whole - receipt.embree_seconds, receipt.embree_seconds


PAIR_ROUNDS = 15
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
    for number in range(PAIR_ROUNDS):
        # The other one first every other time, so that a drift of the clock favours neither.
        first = number % 2
        seconds = {which: _seconds(scenes[which]) for which in (first, 1 - first)}
        ratios.append(seconds[0] / seconds[1])
    return summary(name, ratios, 1.02)


def _seconds(scene: Scene) -> float:
    return render(scene, compiled=False).receipt.wall_seconds


QUOTED = 351
"""Seconds that a lecture quotes for two meshes of 100,000 triangles, one moving, an area light, a reflecting floor,
800 x 480 pixels, 100 samples each."""


def measure_dragons() -> list[Figure]:
    """The whole render, without loading the scene."""
    scene = load_scene(SCENES / "dragons.yaml")
    render(scene, spp=1)
    seconds = [render(scene).receipt.wall_seconds for _ in range(3)]
    return [summary(f"dragons: seconds (a lecture quotes {QUOTED})", seconds, QUOTED)]
