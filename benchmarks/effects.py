"""What each effect costs: its scene against the time inside Embree, and what lens and motion add to a camera ray."""

from __future__ import annotations

from benchmarks.engine import SCENES
from benchmarks.figures import Figure, summary
from course import Scene, load_scene, render
from course.effects import PROJECT

EFFECTS = ("supersampling", "soft_shadows", "glossy", "thin_lens", "motion_blur", "cube_map")
REPETITIONS = 5


def measure_effects() -> list[Figure]:
    """Ratios on two threads."""
    figures = [_embree_bound(name) for name in EFFECTS]
    plain = load_scene(SCENES / "direct_light.yaml")
    for name in ("lens", "motion"):
        with_effect = load_scene(SCENES / f"direct_light_{name}.yaml")
        render(plain, compiled=False)
        render(with_effect, compiled=False)
        added = []
        for _ in range(REPETITIONS):
            own, embree = _seconds(plain)
            own_with, _ = _seconds(with_effect)
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
    for _ in range(REPETITIONS):
        receipt = render(scene, size=size, spp=16, compiled=False).receipt
        ratios.append(receipt.wall_seconds * receipt.threads / receipt.embree_seconds)
    return summary(f"scenes/{name}: threads x wall clock / inside Embree", ratios, 1.9)


def _seconds(scene: Scene) -> tuple[float, float]:
    """Seconds of all threads outside and inside Embree."""
    receipt = render(scene, compiled=False).receipt
    whole = receipt.wall_seconds * receipt.threads
    return whole - receipt.embree_seconds, receipt.embree_seconds
