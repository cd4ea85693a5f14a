"""What adaptive sampling saves: rays to an equal error, uniform over adaptive, for the gallery and the effects.

Rays are counted, not timed. Uniform pictures give the error over rays; the adaptive picture's own error, against the
same reference, says how many rays uniform sampling would have needed for it.
"""

from collections.abc import Callable

import numpy as np

from benchmarks.figures import Figure, summary
from course import Picture, Scene, load_scene, render
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import MODULES

HEIGHT = 96
REFERENCE = 2048
"""Samples a pixel; its squared error is a 30th of that of 64 samples, or less."""

UNIFORM = (16, 64, 256)
SEEDS = (1, 2, 3)
GALLERY = tuple(sorted(path.stem for path in (PROJECT / "scenes" / "gallery").glob("*.yaml")))


def measure_adaptive() -> list[Figure]:
    """For each scene the rays that uniform sampling takes over those that adaptive sampling takes."""
    scenes = [f"gallery/{name}" for name in GALLERY] + list(MODULES)
    return [_figure(name) for name in scenes]


def _figure(name: str) -> Figure:
    scene = load_scene(PROJECT / "scenes" / f"{name}.yaml")
    settings = scene.settings
    size = max(HEIGHT * settings.width // settings.height, 1), HEIGHT
    reference = render(scene, spp=REFERENCE, size=size, seed=99, sampler="sobol").linear.astype(
        np.float64
    )

    def error(picture: Picture) -> float:
        return float(np.sqrt(((picture.linear - reference) ** 2).mean()))

    uniform = [_point(scene, size, spp, error) for spp in UNIFORM]
    logs = np.log(uniform)
    # Aimed at what uniform sampling reaches with 64 samples.
    target = uniform[1][1]
    gains = []
    for seed in SEEDS:
        picture = render(scene, size=size, error=target, spp=4096, seed=seed, sampler="sobol")
        equal = np.exp(np.interp(-np.log(error(picture)), -logs[:, 1], logs[:, 0]))
        gains.append(float(equal) / _rays(picture))
    goal = 1 / 1.1
    return summary(f"{name}: rays, uniform / adaptive", gains, round(goal, 3), at_least=True)


def _point(
    scene: Scene, size: tuple[int, int], spp: int, error: Callable[[Picture], float]
) -> tuple[float, float]:
    pictures = [render(scene, size=size, spp=spp, seed=seed, sampler="sobol") for seed in SEEDS[:2]]
    errors = [error(picture) for picture in pictures]
    return float(_rays(pictures[0])), float(np.sqrt(np.mean(np.square(errors))))


def _rays(picture: Picture) -> int:
    return sum(picture.receipt.rays.values())
